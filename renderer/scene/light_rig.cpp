// The lights stand at fixed angles to the camera's axes, their strength worked out from the radiance of white Lambert.
#include "renderer/scene/light_rig.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

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

Environment supplied_environment() {
  Environment studio{.name = "studio", .radiance = nullptr};
  Image map(256, 128, 3);
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const double radiance =
          studio_radiance(environment_direction(studio, (x + 0.5) / map.width, (y + 0.5) / map.height));
      std::ranges::fill(map.at(x, y), static_cast<float>(radiance));
    }
  }
  studio.radiance = std::make_shared<const Image>(std::move(map));
  return studio;
}

std::vector<Light> supplied_lights(const Camera& camera, const Bounds& bounds) {
  const glm::mat3 axes{camera.world};
  // To the lights, in the camera's axes: +z is towards the camera.
  const glm::vec3 to_key = glm::normalize(glm::vec3{-0.5F, 0.6F, 1.0F});
  const glm::vec3 to_fill = glm::normalize(glm::vec3{0.8F, -0.3F, 0.8F});
  const glm::vec3 to_point = glm::normalize(glm::vec3{0.35F, 0.45F, 1.0F});
  const float distance = 3.0F * std::max(bounds.radius(), 0.5e-3F);
  const auto directional = [&](const glm::vec3& to_light, float radiance) {
    return DirectionalLight{axes * -to_light, glm::vec3{illuminance_for(radiance, to_light.z)}};
  };
  const float candela = illuminance_for(0.2F, to_point.z) * distance * distance;
  return {directional(to_key, 0.5F), directional(to_fill, 0.1F),
          PointLight{bounds.centre() + axes * to_point * distance, glm::vec3{candela}, std::nullopt}};
}

}  // namespace footprint
