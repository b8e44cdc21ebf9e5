// A scene's triangles as plain numbers that a shader can trace rays through.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "renderer/scene/scene.hpp"

namespace footprint {

/// A bounding volume hierarchy in depth-first order: a ray that misses a node goes on at its `skip`, else at the next
/// one, so that no stack is needed. Built by Embree.
struct RayTree {
  /// In the std430 layout of shadow_rays.glsl.
  struct Node {
    glm::vec3 lower{0.0F};
    std::uint32_t skip = 0;  ///< the node behind this one and all below it
    glm::vec3 upper{0.0F};
    std::uint32_t triangles = 0;  ///< 8 * first + number, at most 7; none in an inner node
  };
  struct Triangle {
    glm::vec4 corner{0.0F}, edge_u{0.0F}, edge_v{0.0F};  ///< metres; w is not used
  };
  std::vector<Node> nodes;
  std::vector<Triangle> triangles;

  /// Whether a ray meets a triangle, as the shader asks; `direction` of any length but 0. For tests and tools:
  /// Occluders are far faster.
  [[nodiscard]] bool blocked(const glm::vec3& origin, const glm::vec3& direction) const;
};

/// All triangles of the scene; an alpha mask is not looked at. Errors (machine): memory is out, or more than 2^28
/// triangles.
[[nodiscard]] RayTree ray_tree(const Scene& scene);

}  // namespace footprint
