// Rays from points on the surface to the lights, and away from them.
#include "renderer/visibility/cast_shadows.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>

namespace footprint {
namespace {

struct RayFrom {
  glm::vec3 point;

  [[nodiscard]] std::optional<LightRay> operator()(const PointLight& light) const {
    const glm::vec3 to_light = light.position - point;
    const float distance = glm::length(to_light);
    const bool reaches = distance > 0.0F && (!light.range || distance < *light.range);
    if (!reaches || light.intensity == glm::vec3(0.0F)) return {};
    return LightRay{to_light / distance, distance};
  }

  [[nodiscard]] std::optional<LightRay> operator()(const SpotLight& light) const {
    const auto ray = (*this)(light.point);
    if (!ray || -glm::dot(ray->direction, light.direction) <= std::cos(light.outer_cone_angle)) return {};
    return ray;
  }

  [[nodiscard]] std::optional<LightRay> operator()(const DirectionalLight& light) const {
    if (light.illuminance == glm::vec3(0.0F)) return {};
    return LightRay{-light.direction, std::numeric_limits<float>::infinity()};
  }

  [[nodiscard]] std::optional<LightRay> operator()(const AreaLight& light) const {
    const auto ray = (*this)(PointLight{.position = light.position, .intensity = light.intensity, .range = {}});
    const bool shines_here =
        light.shape == AreaShape::sphere || (ray && glm::dot(ray->direction, light.direction) < 0.0F);
    return shines_here ? ray : std::nullopt;
  }
};

constexpr std::size_t fewest_area_points = 4096;  // so that large triangles are looked at closely
constexpr float near_corner = 0.9F;               // of the way from the middle to a corner

// A light closer to a triangle's plane than this does not shine on it: rays along a surface meet its own triangles.
constexpr float grazing = 1e-3F;

bool is_double_sided(const Scene& scene, const SurfacePoint& point) {
  return scene.materials[static_cast<std::size_t>(scene.meshes[point.mesh].material)].double_sided;
}

struct TriangleId {
  std::size_t mesh, triangle;
};

std::vector<TriangleId> all_triangles(const Scene& scene) {
  std::vector<TriangleId> triangles;
  for (std::size_t mesh = 0; mesh < scene.meshes.size(); ++mesh) {
    for (std::size_t i = 0; i < scene.meshes[mesh].indices.size() / 3; ++i) triangles.push_back({mesh, i});
  }
  return triangles;
}

double area(const Occluders& occluders, const TriangleId& id) {
  const auto [a, b, c] = occluders.corners(id.mesh, id.triangle);
  return 0.5 * glm::length(glm::cross(glm::dvec3(b->position) - glm::dvec3(a->position),
                                      glm::dvec3(c->position) - glm::dvec3(a->position)));
}

// The middle and a point near each corner.
std::array<SurfacePoint, 4> points_of(const TriangleId& id) {
  constexpr float middle = 1.0F / 3.0F;
  constexpr float far = middle + near_corner * (1.0F - middle);
  constexpr float rest = 0.5F * (1.0F - far);
  return {{{id.mesh, id.triangle, middle, middle},
           {id.mesh, id.triangle, rest, rest},
           {id.mesh, id.triangle, far, rest},
           {id.mesh, id.triangle, rest, far}}};
}

// A point of a triangle for a number in [0, 1): the numbers i / n spread evenly over it (the triangle is halved again
// and again, Basu and Owen 2015).
SurfacePoint point_for(const TriangleId& id, double number) {
  glm::dvec2 a(0.0), b(1.0, 0.0), c(0.0, 1.0);
  for (int depth = 0; depth < 12; ++depth) {
    number *= 4.0;
    const int quarter = std::min(static_cast<int>(number), 3);
    number -= quarter;
    const glm::dvec2 ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
    const std::array<std::array<glm::dvec2, 3>, 4> parts{{{bc, ca, ab}, {a, ab, ca}, {ab, b, bc}, {ca, bc, c}}};
    a = parts.at(static_cast<std::size_t>(quarter))[0];
    b = parts.at(static_cast<std::size_t>(quarter))[1];
    c = parts.at(static_cast<std::size_t>(quarter))[2];
  }
  const glm::vec2 middle((a + b + c) / 3.0);
  return {id.mesh, id.triangle, middle.x, middle.y};
}

void append_by_area(const std::vector<TriangleId>& triangles, const Occluders& occluders, std::size_t count,
                    std::vector<SurfacePoint>& points) {
  std::vector<double> upto;
  double total = 0;
  for (const TriangleId& id : triangles) upto.push_back(total += area(occluders, id));
  if (!(total > 0.0)) return;
  for (std::size_t i = 0; i < count; ++i) {
    const double wanted = total * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    const auto found = std::min(std::ranges::upper_bound(upto, wanted), upto.end() - 1);
    const auto index = static_cast<std::size_t>(found - upto.begin());
    const double before = index == 0 ? 0.0 : upto[index - 1];
    points.push_back(point_for(triangles[index], (wanted - before) / (upto[index] - before)));
  }
}

// Whether a point is shadowed from a light, or shadows another one.
bool shadows(const Scene& scene, const Occluders& occluders, const Light& light, const SurfacePoint& point) {
  const auto facing = [&](const SurfacePoint& at, const glm::vec3& to_light) {
    return glm::dot(occluders.normal(at.mesh, at.triangle), to_light);
  };
  const auto lit = [&](const SurfacePoint& at, float side) {
    return (is_double_sided(scene, at) ? std::abs(side) : side) > grazing;
  };
  const glm::vec3 position = occluders.position(point);
  const auto ray = ray_to_light(light, position);
  if (!ray) return false;
  const float side = facing(point, ray->direction);
  const glm::vec3 start =
      position + std::copysign(occluders.offset(), side) * occluders.normal(point.mesh, point.triangle);
  if (lit(point, side) && occluders.blocked(start, ray->direction, ray->distance)) return true;
  if (side <= 0.0F && occluders.open_from_behind(point.mesh)) return false;
  const auto next = occluders.nearest(position, -ray->direction, 2.0F * occluders.offset());
  return next && lit(*next, facing(*next, ray->direction)) && ray_to_light(light, occluders.position(*next));
}

constexpr int directions_per_point = 16;
constexpr float lowest = 0.05F;  // over the plane, as a sine: lower ones meet the surface's own uneven triangles

// Directions of equal solid angle, turned from point to point.
glm::vec3 spread_direction(std::size_t point, int i) {
  constexpr double golden = 0.6180339887498949;
  const double z = 1.0 - (2.0 * i + 1.0) / directions_per_point;
  const double azimuth = 2.0 * std::numbers::pi * (golden * (static_cast<double>(point) * directions_per_point + i));
  const double r = std::sqrt(1.0 - z * z);
  return {static_cast<float>(r * std::cos(azimuth)), static_cast<float>(r * std::sin(azimuth)), static_cast<float>(z)};
}

bool sees_something(const Scene& scene, const Occluders& occluders, const SurfacePoint& point, std::size_t index) {
  const glm::vec3 normal = occluders.normal(point.mesh, point.triangle);
  const bool both_sides = is_double_sided(scene, point);
  for (int i = 0; i < directions_per_point; ++i) {
    const glm::vec3 direction = spread_direction(index, i);
    const float elevation = glm::dot(direction, normal);
    if ((both_sides ? std::abs(elevation) : elevation) < lowest) continue;
    const glm::vec3 start = occluders.position(point) + std::copysign(occluders.offset(), elevation) * normal;
    if (occluders.blocked(start, direction)) return true;
  }
  return false;
}

// Whether `test` (point, its index) is true for any point; in parallel.
template <class Test>
bool any_of(const std::vector<SurfacePoint>& points, const Test& test) {
  std::atomic<bool> found = false;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), 64), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end() && !found; ++i) {
      if (test(points[i], i)) found = true;
    }
  });
  return found;
}

}  // namespace

std::optional<LightRay> ray_to_light(const Light& light, const glm::vec3& point) {
  return std::visit(RayFrom{point}, light);
}

bool hides_surroundings(const Scene& scene, const Occluders& occluders, std::size_t limit) {
  return any_of(spread_points(scene, occluders, limit),
                [&](const SurfacePoint& point, std::size_t i) { return sees_something(scene, occluders, point, i); });
}

std::vector<SurfacePoint> spread_points(const Scene& scene, const Occluders& occluders, std::size_t limit) {
  std::vector<TriangleId> triangles = all_triangles(scene);
  std::erase_if(triangles, [&](const TriangleId& id) { return !(area(occluders, id) > 0.0); });
  std::vector<SurfacePoint> points;
  const std::size_t looked_at = std::min(triangles.size(), limit);
  for (std::size_t i = 0; i < looked_at; ++i) {
    const auto of_triangle = points_of(triangles[i * triangles.size() / looked_at]);
    points.insert(points.end(), of_triangle.begin(), of_triangle.end());
  }
  append_by_area(triangles, occluders, std::clamp(looked_at, std::min(fewest_area_points, limit), limit), points);
  std::erase_if(points, [&](const SurfacePoint& point) { return !occluders.present(point); });
  return points;
}

std::vector<bool> lights_casting_shadows(const Scene& scene, const Occluders& occluders, std::size_t limit) {
  const std::vector<SurfacePoint> points = spread_points(scene, occluders, limit);
  std::vector<bool> casting;
  for (const Light& light : scene.lights) {
    casting.push_back(any_of(points, [&](const SurfacePoint& point, std::size_t /*index*/) {
      return shadows(scene, occluders, light, point);
    }));
  }
  return casting;
}

}  // namespace footprint
