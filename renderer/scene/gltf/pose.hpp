// The pose of a glTF file at a time of an animation, and its primitives placed in the world.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "renderer/scene/gltf/document.hpp"
#include "renderer/scene/gltf/material.hpp"
#include "renderer/scene/origin.hpp"
#include "renderer/scene/scene.hpp"

namespace footprint {

/// A node's own transform: its matrix, or translation * rotation * scale. Throws Error (usage) that names `place`: a
/// rotation without length.
[[nodiscard]] glm::dmat4 local_transform(const nlohmann::json& node, const std::string& place);

/// How a node poses its mesh.
struct MeshPose {
  glm::dmat4 world{1.0};           ///< the node's transform; with joints it has no effect (glTF 2.0, section 3.7.3.3)
  std::vector<glm::dmat4> joints;  ///< of its skin, from the mesh to the world; empty: no skin
  std::vector<double> weights;     ///< of its morph targets; those that are missing are 0
};

/// The pose measured from another place of the world.
[[nodiscard]] MeshPose seen_from(const glm::dvec3& origin, MeshPose pose);

/// All nodes of a file at one time.
struct Pose {
  nlohmann::json nodes;            ///< as in the file, with the transforms and weights of that time
  std::vector<int> parents;        ///< of each node; -1: a root
  std::optional<Motion> motion{};  ///< none without an animation
};

/// animation: index; none: every node has the transform and the weights that the file gives it.
/// time: seconds; clamped to the first and last key.
/// Throws Error (usage) that names the animation: keys that do not rise, a wrong number of values, an animated node
/// with a matrix.
[[nodiscard]] Pose pose_at(const GltfDocument& document, const std::optional<std::size_t>& animation, double time);

/// The pose of the mesh of a node whose transform is `world`. Throws Error (usage): a skin whose joints are no tree, or
/// with fewer inverse bind matrices than joints.
[[nodiscard]] MeshPose mesh_pose(const GltfDocument& document, const Pose& pose, const nlohmann::json& node,
                                 const glm::dmat4& world);

/// The bounds of the triangles of a primitive in the world; empty for points, lines and primitives without a triangle.
/// Throws Error (usage) that names mesh, primitive and vertex: a position that is not finite or beyond 1e15 m, or
/// indices or joints out of range.
[[nodiscard]] WideBounds primitive_bounds(const GltfDocument& document, std::size_t mesh, std::size_t primitive,
                                          const MeshPose& pose);

/// Converts a primitive. Missing normals become flat; unusable normals, tangents and texture coordinates are replaced,
/// with a line in `warnings`. None for points, lines and primitives without a whole triangle. `Mesh::material` is not
/// set.
/// pose: how its node places, morphs and skins it.
/// material: the texture coordinates of its maps determine the tangents.
/// sets: the file's sets of texture coordinates that vertices have.
/// Throws Error (usage) that names mesh, primitive and vertex: attributes of different length, and as primitive_bounds
/// except for positions beyond 1e15 m.
[[nodiscard]] std::optional<Mesh> convert_primitive(const GltfDocument& document, std::size_t mesh,
                                                    std::size_t primitive, const MeshPose& pose,
                                                    const Material& material, const UvSets& sets,
                                                    std::vector<std::string>& warnings);

}  // namespace footprint
