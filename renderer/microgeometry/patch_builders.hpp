// What patches are put together from: height fields over a grid, and strips of quadrilaterals.
#pragma once

#include <functional>
#include <glm/glm.hpp>

#include "renderer/core/options.hpp"
#include "renderer/microgeometry/patch.hpp"

namespace footprint {

/// Triangles of z = height(x, y) over [0, 1) x [0, 1), which `height` must repeat; columns x rows squares, each cut
/// along the diagonal from its lower left.
[[nodiscard]] Patch height_field_patch(std::string name, int columns, int rows,
                                       const std::function<double(double, double)>& height);

/// Adds the quadrilaterals between the points of a grid, two triangles each, counter-clockwise in (u, v): point(u, v)
/// for u in 0..columns, v in 0..rows. Triangles without area are left out.
void add_grid(Patch& patch, int columns, int rows, std::uint8_t paint, const std::function<glm::vec3(int, int)>& point);

/// The generators behind `patch_kinds`.
[[nodiscard]] Patch weave_patch(const Options& parameters, std::uint64_t seed);
[[nodiscard]] Patch noise_patch(const Options& parameters, std::uint64_t seed);
[[nodiscard]] Patch spheres_patch(const Options& parameters, std::uint64_t seed);

}  // namespace footprint
