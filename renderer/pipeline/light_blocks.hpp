// The lights of a scene in the std140 layout of surface_lights.glsl.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "renderer/scene/scene.hpp"

namespace footprint {

/// One vector a light kind, four floats a member, in the order of the shader's structs.
struct LightBlocks {
  std::vector<glm::vec4> point;        ///< 2 a light: position and range (0: unlimited), intensity and shadow map
  std::vector<glm::vec4> spot;         ///< 4 a light: as point, then direction, cone scale and offset
  std::vector<glm::vec4> directional;  ///< 2 a light: direction to the light, illuminance and shadow map
};

/// `first_maps`: the number of each light's first shadow map; empty where there are none.
[[nodiscard]] LightBlocks light_blocks(std::span<const Light> lights, std::span<const int> first_maps = {});

}  // namespace footprint
