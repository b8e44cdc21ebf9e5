// Framing by the bounds' corners; supplied lights relative to the camera.
#include "renderer/scene/camera.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "renderer/core/error.hpp"
#include "renderer/scene/assembly/load_scene.hpp"

namespace footprint {
namespace {

/// Illuminance for a given radiance of white Lambert: radiance = illuminance * cosine / pi.
float illuminance_for(float radiance, float cosine) { return radiance * std::numbers::pi_v<float> / cosine; }

// Radiance of the supplied environment: floor, ceiling and the middle of each light.
constexpr double floor_radiance = 0.08, ceiling_radiance = 0.35, lamp_radiance = 1.0, lamp_sharpness = 12.0;

double studio_radiance(const glm::dvec3& direction) {
  static const glm::dvec3 left = glm::normalize(glm::dvec3(-1.0, 0.8, 0.6));
  static const glm::dvec3 right = glm::normalize(glm::dvec3(1.0, 0.6, 0.3));
  const double height = 0.5 + 0.5 * direction.y;
  const double walls = glm::mix(floor_radiance, ceiling_radiance, height * height * (3.0 - 2.0 * height));
  const auto lamp = [&](const glm::dvec3& to) { return std::exp(lamp_sharpness * (glm::dot(direction, to) - 1.0)); };
  return walls + lamp_radiance * (lamp(left) + 0.5 * lamp(right));
}

}  // namespace

glm::mat4 look_at(const glm::dvec3& position, const glm::dvec3& target, const glm::dvec3& up) {
  const glm::dvec3 back = glm::normalize(position - target);
  glm::dvec3 right = glm::cross(up, back);
  if (glm::length(right) < 1e-6 * glm::length(up)) {
    right = glm::cross(std::abs(back.z) < 0.9 ? glm::dvec3{0.0, 0.0, 1.0} : glm::dvec3{0.0, 1.0, 0.0}, back);
  }
  right = glm::normalize(right);
  return glm::mat4{glm::dmat4{glm::dvec4{right, 0.0}, glm::dvec4{glm::cross(back, right), 0.0}, glm::dvec4{back, 0.0},
                              glm::dvec4{position, 1.0}}};
}

Camera frame_bounds(const Bounds& bounds, const Framing& framing) {
  const glm::dvec3 centre{bounds.centre()};
  const double radius = bounds.radius() > 0.0F ? static_cast<double>(bounds.radius()) : 0.5;
  const glm::dvec3 direction = glm::normalize(framing.direction);
  const glm::dmat3 axes{glm::dmat4{look_at(direction, glm::dvec3{0.0}, {0.0, 1.0, 0.0})}};
  const double tan_y = std::tan(framing.yfov / 2.0), tan_x = tan_y * framing.aspect;
  const glm::dvec3 half{(bounds.upper - bounds.lower) * 0.5F};
  double distance = bounds.radius() > 0.0F ? 0.0 : radius / std::min(tan_x, tan_y);
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 signs{(corner & 1) != 0 ? 1.0 : -1.0, (corner & 2) != 0 ? 1.0 : -1.0,
                           (corner & 4) != 0 ? 1.0 : -1.0};
    const glm::dvec3 seen = glm::transpose(axes) * (half * signs);
    distance = std::max({distance, seen.z + std::abs(seen.x) / tan_x, seen.z + std::abs(seen.y) / tan_y});
  }
  distance *= framing.margin;
  Camera camera;
  camera.world = look_at(centre + direction * distance, centre, {0.0, 1.0, 0.0});
  camera.yfov = static_cast<float>(framing.yfov);
  // The planes enclose the bounds; a hundredth of the distance preserves depth resolution.
  camera.znear = static_cast<float>(std::max(distance - 1.5 * radius, 0.01 * distance));
  camera.zfar = static_cast<float>(distance + 2.0 * radius);
  return camera;
}

Camera camera_at_distance(const Scene& scene, double factor) {
  if (!(factor > 0.0) || !std::isfinite(factor)) {
    throw Error(ErrorKind::usage, "distance", "must be a number above 0", "give a factor such as 2");
  }
  Camera camera = scene.camera;
  if (camera.orthographic) {
    camera.ymag = static_cast<float>(camera.ymag * factor);
    return camera;
  }
  const glm::dvec3 forward = -glm::dvec3{camera.world[2]};
  const glm::dvec3 eye{camera.world[3]};
  double depth = glm::dot(glm::dvec3{scene.bounds.centre()} - eye, forward);
  // For a camera inside the scene, or looking away, the size of the bounds replaces the distance.
  if (depth <= 0.0) depth = scene.bounds.radius() > 0.0F ? static_cast<double>(scene.bounds.radius()) : 1e-6;
  const double shift = (factor - 1.0) * depth;
  camera.world[3] = glm::vec4{glm::vec3{eye - forward * shift}, 1.0F};
  // The planes keep their position in the world; moving closer, they come no nearer than in proportion.
  const double least = std::min(factor, 1.0);
  const auto follow = [&](float plane) { return static_cast<float>(std::max(plane + shift, plane * least)); };
  camera.znear = follow(camera.znear);
  if (camera.zfar) camera.zfar = follow(*camera.zfar);
  return camera;
}

Environment supplied_environment() {
  Environment studio{.name = "studio", .radiance = nullptr};
  Image map(256, 128, 3);
  for_each_texel(map, [&](int x, int y) {
    const double radiance =
        studio_radiance(environment_direction(studio, (x + 0.5) / map.width, (y + 0.5) / map.height));
    std::ranges::fill(map.at(x, y), static_cast<float>(radiance));
  });
  studio.radiance = std::make_shared<const Image>(std::move(map));
  return studio;
}

std::vector<Light> supplied_lights(const Camera& camera, const Bounds& bounds) {
  const glm::mat3 axes{camera.world};
  // To the lights, in the camera's axes: +z is towards the camera.
  const glm::vec3 to_key = glm::normalize(glm::vec3{-0.5F, 0.6F, 1.0F});
  const glm::vec3 to_fill = glm::normalize(glm::vec3{0.8F, -0.3F, 0.8F});
  const glm::vec3 to_point = glm::normalize(glm::vec3{0.35F, 0.45F, 1.0F});
  const float distance = 3.0F * (bounds.radius() > 0.0F ? bounds.radius() : 0.5F);
  const auto directional = [&](const glm::vec3& to_light, float radiance) {
    return DirectionalLight{axes * -to_light, glm::vec3{illuminance_for(radiance, to_light.z)}};
  };
  const float candela = illuminance_for(0.2F, to_point.z) * distance * distance;
  return {directional(to_key, 0.5F), directional(to_fill, 0.1F),
          PointLight{bounds.centre() + axes * to_point * distance, glm::vec3{candela}, std::nullopt}};
}

}  // namespace footprint
