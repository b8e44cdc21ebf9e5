// From a point to a light: the way that must be clear for the light to reach it.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "renderer/scene/scene.hpp"

namespace footprint {

/// A straight way from a point to a light.
struct LightRay {
  glm::vec3 direction;  ///< from the point to the light, unit
  float distance;       ///< metres, infinite for a directional light
};

/// The way from `point` to `light`; none where the light sends nothing there (outside of its cone or beyond its range,
/// or black) or stands at the point itself.
[[nodiscard]] std::optional<LightRay> ray_to_light(const Light& light, const glm::vec3& point);

}  // namespace footprint
