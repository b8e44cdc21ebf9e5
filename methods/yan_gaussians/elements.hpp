// One 4D Gaussian a texel: where it lies on the map, its normal on the disc, and how the normal changes across it.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "renderer/image/image.hpp"
#include "renderer/scene/material.hpp"

namespace footprint {

/// Standard deviation of an element's position along each axis, in texels: full width at half maximum one texel (Yan
/// 2016), 1 / sqrt(8 ln 2). `seed_deviation` of yan_sum.glsl is its twin.
inline constexpr double seed_deviation = 0.42466090014400953;

/// Slopes of (n_x, n_y) a texel: dnx/du, dnx/dv, dny/du, dny/dv.
using NormalJacobian = std::array<float, 4>;

/// The elements of a map that repeats along both axes: those of a map that does not are twice as many, its mirror image
/// following it.
struct Elements {
  Image normals;                          ///< 4 channels, unit normals, weight 1
  std::vector<NormalJacobian> jacobians;  ///< one a texel, row by row; empty: constant normals
};

/// The elements of a material's normal map. Invalid normals become the mean of the valid ones around them, since a hole
/// has no element; of a map without a valid one (0, 0, 1). `jacobians`: by central differences over the neighbours.
[[nodiscard]] Elements make_elements(const Material& material, bool jacobians);

/// How far an element's normals reach about its own for each deviation of cut-off, on the disc, along any axis: from
/// position and spread together; on the sphere, so that it holds of lobes too (README, "The hierarchy").
[[nodiscard]] float normal_reach(const Elements& elements, std::size_t texel);

}  // namespace footprint
