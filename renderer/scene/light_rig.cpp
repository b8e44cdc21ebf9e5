// The lights stand at fixed angles to the camera's axes, their strength worked out from the radiance of white Lambert.
#include "renderer/scene/light_rig.hpp"

#include <algorithm>
#include <numbers>

namespace footprint {
namespace {

/// Illuminance for a given radiance of white Lambert: radiance = illuminance * cosine / pi.
float illuminance_for(float radiance, float cosine) { return radiance * std::numbers::pi_v<float> / cosine; }

}  // namespace

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
