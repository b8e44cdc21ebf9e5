// Vectors of each kind of light in the scene's order, and frustums around the parts of the scene that they reach.
#include "renderer/pipeline/lights.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <optional>
#include <variant>

namespace footprint {
namespace {

void append(std::vector<glm::vec4>& block, const PointLight& light, float first_map) {
  block.emplace_back(light.position, light.range.value_or(0.0F));
  block.emplace_back(light.intensity, first_map);
}

struct LightAppender {
  LightBlocks& blocks;
  float first_map;

  [[nodiscard]] std::vector<glm::vec4>& of(std::size_t kind) const { return blocks.vectors.at(kind); }

  void operator()(const PointLight& light) const { append(of(light_type::point), light, first_map); }

  void operator()(const SpotLight& light) const {
    append(of(light_type::spot), light.point, first_map);
    of(light_type::spot).emplace_back(light.direction, 0.0F);
    // KHR_lights_punctual, "Inner and Outer Cone Angles": the same guard against equal angles.
    const float scale = 1.0F / std::max(0.001F, std::cos(light.inner_cone_angle) - std::cos(light.outer_cone_angle));
    of(light_type::spot).emplace_back(scale, -std::cos(light.outer_cone_angle) * scale, 0.0F, 0.0F);
  }

  void operator()(const DirectionalLight& light) const {
    of(light_type::directional).emplace_back(-light.direction, 0.0F);
    of(light_type::directional).emplace_back(light.illuminance, first_map);
  }

  void operator()(const AreaLight& light) const {
    std::vector<glm::vec4>&area = of(light_type::area), &area_points = of(light_type::area_point);
    const auto number = static_cast<float>(area.size() / light_types[light_type::area].vectors);
    area.emplace_back(light.position, light.area());
    area.emplace_back(light.across, light.half_size.x);
    area.emplace_back(light.up, light.half_size.y);
    area.emplace_back(light.direction, static_cast<float>(light.shape));
    area.emplace_back(light.intensity, first_map);
    area.emplace_back(1.0F / static_cast<float>(light.points), 0.0F, 0.0F, 0.0F);
    const bool by_lobes = light.integral == AreaIntegral::lobes;
    std::vector<glm::vec4> points;
    for (const glm::vec3& point : footprint::area_points(light)) points.emplace_back(point, number);
    area_points.insert(by_lobes ? area_points.end() : area_points.begin(), points.begin(), points.end());
    if (by_lobes) ++blocks.area_by_lobes;
    if (!by_lobes) blocks.points_alone += points.size();
  }
};

// Whether methods integrate a light by points alone.
bool by_points(const Light& light) {
  const auto* area = std::get_if<AreaLight>(&light);
  return area != nullptr && area->integral == AreaIntegral::points;
}

constexpr double margin_texels = 4.0;    // on each side: a comparison and the offset along the normal reach over two
constexpr double widest_tangent = 1.74;  // half of 120 degrees: beyond that six maps have better texels
constexpr double thinnest = 1e-3;        // a map's narrow side over its long one: bounds seen edge-on have no width
constexpr double rounding = 1e-6;        // of a few 32-bit operations on a coordinate, relative to it

// A map's own directions.
struct Frame {
  glm::dvec3 right, up, axis;
};

Frame frame_along(const glm::dvec3& axis) {
  const glm::dvec3 other = std::abs(axis.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
  const glm::dvec3 right = glm::normalize(glm::cross(axis, other));
  return {right, glm::cross(right, axis), axis};
}

std::array<glm::dvec3, 8> corners_of(const Bounds& bounds) {
  std::array<glm::dvec3, 8> corners{};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    corners.at(i) = {(i & 1U) != 0 ? bounds.upper.x : bounds.lower.x, (i & 2U) != 0 ? bounds.upper.y : bounds.lower.y,
                     (i & 4U) != 0 ? bounds.upper.z : bounds.lower.z};
  }
  return corners;
}

// The extent of a map on the plane at w = 1, and along the axis.
struct Extent {
  glm::dvec2 lower{1e300}, upper{-1e300};
  double nearest = 1e300, furthest = -1e300;

  void add(const glm::dvec2& point, double depth) {
    lower = glm::min(lower, point);
    upper = glm::max(upper, point);
    nearest = std::min(nearest, depth);
    furthest = std::max(furthest, depth);
  }

  [[nodiscard]] glm::dvec2 size() const { return upper - lower; }

  // No side without length, and a margin around all.
  void pad(int resolution) {
    const double longest = std::max({size().x, size().y, 1e-30});
    const glm::dvec2 middle = 0.5 * (lower + upper);
    const glm::dvec2 half =
        0.5 * glm::max(size(), glm::dvec2(thinnest * longest)) * (resolution / (resolution - 2.0 * margin_texels));
    lower = middle - half;
    upper = middle + half;
    const double depth = std::max(furthest - nearest, 1e-30);
    nearest -= 0.01 * depth;
    furthest += 0.01 * depth;
  }
};

// Rows that act on (p, 1): a plane's dot product with the point, less that with the origin.
glm::dvec4 row(const glm::dvec3& direction, const glm::dvec3& origin) {
  return {direction, -glm::dot(direction, origin)};
}

ShadowView view_of(const Frame& frame, const glm::dvec3& origin, const Extent& extent, bool perspective,
                   const Scene& scene) {
  const glm::dvec4 right = row(frame.right, origin), up = row(frame.up, origin), along = row(frame.axis, origin);
  const glm::dvec4 one(0.0, 0.0, 0.0, 1.0);
  const glm::dvec4 w = perspective ? along : one;
  const glm::dmat4 rows((right - extent.lower.x * w) / extent.size().x, (up - extent.lower.y * w) / extent.size().y,
                        (along - extent.nearest * one) / (extent.furthest - extent.nearest), w);
  const glm::dvec3 far_corner =
      glm::max(glm::abs(glm::dvec3(scene.bounds.lower)), glm::abs(glm::dvec3(scene.bounds.upper)));
  ShadowView view;
  view.world_to_map = glm::mat4(glm::transpose(rows));
  view.axis_texel = glm::vec4(frame.axis, std::max(extent.size().x, extent.size().y) / scene.shadows.resolution);
  view.faces_rounding.y = static_cast<float>(rounding * (glm::length(far_corner) + extent.furthest - extent.nearest));
  return view;
}

ShadowView parallel_view(const DirectionalLight& light, const Scene& scene) {
  const Frame frame = frame_along(glm::normalize(glm::dvec3(light.direction)));
  const glm::dvec3 centre(scene.bounds.centre());
  Extent extent;
  for (const glm::dvec3& corner : corners_of(scene.bounds)) {
    const glm::dvec3 d = corner - centre;
    extent.add({glm::dot(frame.right, d), glm::dot(frame.up, d)}, glm::dot(frame.axis, d));
  }
  extent.pad(scene.shadows.resolution);
  return view_of(frame, centre, extent, false, scene);
}

// The extent of the bounds from a point along `frame`; none if it is too wide for one map.
std::optional<Extent> seen_bounds(const Frame& frame, const glm::dvec3& from, const Bounds& bounds) {
  Extent extent;
  for (const glm::dvec3& corner : corners_of(bounds)) {
    const glm::dvec3 d = corner - from;
    const double depth = glm::dot(frame.axis, d);
    const glm::dvec2 across(glm::dot(frame.right, d), glm::dot(frame.up, d));
    if (!(depth > 0.0) || glm::length(across) > widest_tangent * depth) return {};
    extent.add(across / depth, depth);
  }
  return extent;
}

// A light in the midst of things sees them from nothing on to the furthest corner.
Extent all_around(double tangent, const glm::dvec3& from, const Bounds& bounds) {
  Extent extent;
  double furthest = 0;
  for (const glm::dvec3& corner : corners_of(bounds)) furthest = std::max(furthest, glm::length(corner - from));
  extent.add(glm::dvec2(-tangent), 0.0);
  extent.add(glm::dvec2(tangent), std::max(furthest, 1e-30));
  return extent;
}

void append_cube(const glm::dvec3& from, const Scene& scene, std::vector<ShadowView>& views) {
  for (std::size_t face = 0; face < 6; ++face) {
    glm::dvec3 axis(0.0);
    axis[static_cast<int>(face / 2)] = face % 2 == 0 ? 1.0 : -1.0;
    Extent extent = all_around(1.0, from, scene.bounds);
    extent.pad(scene.shadows.resolution);
    views.push_back(view_of(frame_along(axis), from, extent, true, scene));
    views.back().faces_rounding.x = 6.0F;
  }
}

// cone: tangent of the cone along the light's direction; infinite for a light without a cone.
void append_point(const glm::dvec3& from, const glm::dvec3& direction, double cone, const Scene& scene,
                  std::vector<ShadowView>& views) {
  const glm::dvec3 towards = glm::dvec3(scene.bounds.centre()) - from;
  const double distance = glm::length(towards);
  Frame frame = frame_along(distance > 0.0 ? towards / distance : glm::dvec3(0, 0, 1));
  std::optional<Extent> extent = seen_bounds(frame, from, scene.bounds);
  const bool cone_is_narrower = !extent || cone < 0.5 * std::max(extent->size().x, extent->size().y);
  if (cone <= widest_tangent && cone_is_narrower) {
    frame = frame_along(direction);
    extent = all_around(cone, from, scene.bounds);
  }
  if (!extent) return append_cube(from, scene, views);
  extent->pad(scene.shadows.resolution);
  views.push_back(view_of(frame, from, *extent, true, scene));
}

struct ViewAppender {
  const Scene& scene;
  std::vector<ShadowView>& views;

  // A point, or the centre of an area, whose penumbra is left out.
  void operator()(const auto& light) const {
    append_point(light.position, {}, std::numeric_limits<double>::infinity(), scene, views);
  }
  void operator()(const SpotLight& light) const {
    const double angle = light.outer_cone_angle;
    const double cone = angle < 0.5 * std::numbers::pi ? std::tan(angle) : std::numeric_limits<double>::infinity();
    append_point(light.point.position, glm::normalize(glm::dvec3(light.direction)), cone, scene, views);
  }
  void operator()(const DirectionalLight& light) const { views.push_back(parallel_view(light, scene)); }
};

}  // namespace

LightBlocks light_blocks(std::span<const Light> lights, std::span<const int> first_maps) {
  LightBlocks blocks;
  for (const bool last : {false, true}) {
    for (std::size_t i = 0; i < lights.size(); ++i) {
      if (by_points(lights[i]) != last) continue;
      std::visit(LightAppender{blocks, first_maps.empty() ? 0.0F : static_cast<float>(first_maps[i])}, lights[i]);
    }
  }
  return blocks;
}

std::vector<glm::vec3> area_points(const AreaLight& light) {
  std::vector<glm::vec3> points;
  const int count = light.points;
  for (int i = 0; i < count; ++i) {
    float reversed = 0.0F, digit = 0.5F;  // radical inverse of base 2
    for (int rest = i; rest > 0; rest /= 2, digit *= 0.5F) reversed += static_cast<float>(rest % 2) * digit;
    const glm::vec2 u((static_cast<float>(i) + 0.5F) / static_cast<float>(count),
                      reversed + 0.5F / static_cast<float>(std::bit_ceil(static_cast<unsigned>(count))));
    glm::vec2 at = 2.0F * u - 1.0F;
    if (light.shape != AreaShape::rectangle) {
      const float azimuth = 2.0F * std::numbers::pi_v<float> * u.y;
      at = std::sqrt(u.x) * glm::vec2(std::cos(azimuth), std::sin(azimuth));
    }
    points.push_back(light.position + at.x * light.half_size.x * light.across + at.y * light.half_size.y * light.up);
  }
  return points;
}

ShadowViews shadow_views(const Scene& scene) {
  ShadowViews out;
  for (const Light& light : scene.lights) {
    out.first.push_back(static_cast<int>(out.views.size()));
    std::visit(ViewAppender{scene, out.views}, light);
  }
  return out;
}

}  // namespace footprint
