// One glTF primitive, placed in the world: triangles with positions, normals, tangents and texture coordinates.
#pragma once

#include <tiny_gltf.h>

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "renderer/scene/material.hpp"
#include "renderer/scene/scene.hpp"

namespace footprint {

/// Converts primitive `primitive` of mesh `mesh` under the transform `world`. `material` (its maps' texture coordinates
/// decide the tangents) is not set in the result. Normals that the file lacks are flat; normals, tangents and texture
/// coordinates that are no use are replaced, with a line in `warnings`. Empty for points, lines and primitives without
/// a whole triangle. Throws Error (usage) that names mesh and primitive, and the vertex where one is at fault: a
/// position that is not finite or beyond 1e15 m, attributes of different length, indices out of range.
[[nodiscard]] std::optional<Mesh> convert_primitive(const tinygltf::Model& model, int mesh, int primitive,
                                                    const glm::dmat4& world, const Material& material,
                                                    std::vector<std::string>& warnings);

}  // namespace footprint
