// Scenes whose shadows are known from geometry: bodies over a floor.
#pragma once

#include "renderer/scene/scene.hpp"

namespace footprint::testing {

/// A box with outward faces, flat normals, material `material`.
[[nodiscard]] Mesh box_mesh(const glm::vec3& lower, const glm::vec3& upper, int material = 0);

/// A sphere of `rings` x 2 `rings` cells with smooth normals, material `material`.
[[nodiscard]] Mesh sphere_mesh(const glm::vec3& centre, float radius, int rings, int material = 0);

/// The square of side 2 in z = 0 (material 0, white Lambert without a specular term to speak of) and nothing else; a
/// camera straight above sees it whole. No light. Exposure 1.
[[nodiscard]] Scene white_floor();

/// That floor with a box from (-0.25, -0.25, 0.25) to (0.25, 0.25, 0.5) hovering over it.
[[nodiscard]] Scene box_over_floor();

/// Sets the bounds to those of the vertices.
void fit_bounds(Scene& scene);

}  // namespace footprint::testing
