// One glTF primitive, placed in the world: triangles with positions, normals, tangents and texture coordinates.
#pragma once

#include <tiny_gltf.h>

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "renderer/scene/gltf/pose.hpp"
#include "renderer/scene/material.hpp"
#include "renderer/scene/scene.hpp"

namespace footprint {

/// Converts a primitive. Missing normals become flat; unusable normals, tangents and texture coordinates are replaced,
/// with a line in `warnings`. None for points, lines and primitives without a whole triangle. `Mesh::material` is not
/// set.
/// pose: how its node places, morphs and skins it.
/// material: the texture coordinates of its maps determine the tangents.
/// Throws Error (usage) that names mesh, primitive and vertex: a position that is not finite or beyond 1e15 m,
/// attributes of different length, or indices or joints out of range.
[[nodiscard]] std::optional<Mesh> convert_primitive(const tinygltf::Model& model, int mesh, int primitive,
                                                    const MeshPose& pose, const Material& material,
                                                    std::vector<std::string>& warnings);

}  // namespace footprint
