// glTF cameras and KHR_lights_punctual, placed in the world.
#pragma once

#include <tiny_gltf.h>

#include <glm/glm.hpp>

#include "renderer/scene/scene.hpp"

namespace footprint {

/// Camera `index` under the node transform `world`, whose scale and shear are removed. Errors (usage): a type other
/// than perspective or orthographic, a field of view outside (0, pi), planes or sizes out of order.
[[nodiscard]] Camera convert_camera(const tinygltf::Model& model, int index, const glm::dmat4& world);

/// Light `index` of KHR_lights_punctual under the node transform `world`: candela or lux times colour. Errors (usage):
/// another type than point, spot and directional, values that are negative or not finite, cones out of order, a
/// transform that leaves no direction.
[[nodiscard]] Light convert_light(const tinygltf::Model& model, int index, const glm::dmat4& world);

}  // namespace footprint
