// One 4D Gaussian per texel, in position and normal, and the hierarchy over all of them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
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

/// A point of the tree: position (u, v) in shares of the map, normal (n_x, n_y) on the disc.
using TreePoint = std::array<float, 4>;

/// Bounds of a node's points; those of the normals are wider by each point's own reach.
struct TreeBounds {
  TreePoint low{}, high{};

  friend bool operator==(const TreeBounds&, const TreeBounds&) = default;
};

/// Node i has the children 2 i and 2 i + 1; the root is 1, node 0 is not there, and the 2^depth nodes from 2^depth on
/// are leaves. Leaf j holds the points order[j n / 2^depth] up to, without it, order[(j + 1) n / 2^depth], rounded down
/// (`leaf_begin`): at most `most_in_leaf`.
struct ElementTree {
  static constexpr std::size_t most_in_leaf = 8;

  int depth = 0;
  std::vector<std::uint32_t> order;  ///< a permutation of the points' numbers
  std::vector<TreeBounds> nodes;     ///< 2^(depth + 1)

  /// The first place in `order` of leaf `leaf`, 0 to 2^depth (then the number of points).
  [[nodiscard]] std::size_t leaf_begin(std::size_t leaf) const { return (leaf * order.size()) >> depth; }

  friend bool operator==(const ElementTree&, const ElementTree&) = default;
};

/// Splits nodes at the median of the coordinate in which their points lie furthest apart: a whole map is as wide as
/// half of the disc. `reach` widens each point's bounds along both coordinates of its normal. At least one point, as
/// many reaches. The same at any number of threads.
[[nodiscard]] ElementTree build_element_tree(std::span<const TreePoint> points, std::span<const float> reach);

}  // namespace footprint
