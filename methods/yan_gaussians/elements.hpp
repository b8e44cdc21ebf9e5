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

/// Standard deviation of an element's position along each axis, in texels. Its full width at half maximum is one texel
/// (Yan 2016), so it is 1 / sqrt(8 ln 2). `seed_deviation` of yan_sum.glsl is its twin.
inline constexpr double seed_deviation = 0.42466090014400953;

/// The elements of a map that repeats along both axes; others are extended by their mirror image to twice the number.
struct Elements {
  Image normals;      ///< 4 channels, unit normals, weight 1
  Image jacobians{};  ///< slopes of (n_x, n_y) per texel: dnx/du, dnx/dv, dny/du, dny/dv; empty: constant normals
};

/// The elements of a material's normal map. Invalid normals become the mean of the valid ones around them, or (0, 0, 1)
/// if there is none, because every texel needs an element. `jacobians`: compute them, by central differences.
[[nodiscard]] Elements make_elements(const Material& material, bool jacobians);

/// The reach of an element's normals per deviation of the cut-off, along any axis of the disc: from position and spread
/// together. It is measured on the sphere, so that it also bounds lobes (README, "The hierarchy").
[[nodiscard]] float normal_reach(const Elements& elements, std::size_t texel);

/// A point of the tree: position (u, v) in shares of the map, normal (n_x, n_y) on the disc.
using TreePoint = std::array<float, 4>;

/// Bounds of the points of a node, widened for normals by the reach of each point.
struct TreeBounds {
  TreePoint low{}, high{};

  friend bool operator==(const TreeBounds&, const TreeBounds&) = default;
};

/// A complete binary tree. Node i has the children 2 i and 2 i + 1, the root is 1, node 0 is unused, and the 2^depth
/// nodes from 2^depth on are leaves. Leaf j contains the points order[leaf_begin(j)] to order[leaf_begin(j + 1) - 1],
/// at most `most_in_leaf`.
struct ElementTree {
  static constexpr std::size_t most_in_leaf = 8;

  int depth = 0;
  std::vector<std::uint32_t> order;  ///< a permutation of the point indices
  std::vector<TreeBounds> nodes;     ///< 2^(depth + 1)

  /// The first place in `order` of leaf `leaf`, 0 to 2^depth (then the number of points).
  [[nodiscard]] std::size_t leaf_begin(std::size_t leaf) const { return (leaf * order.size()) >> depth; }

  friend bool operator==(const ElementTree&, const ElementTree&) = default;
};

/// Splits nodes at the median of the coordinate with the largest extent, where the whole map counts as half of the
/// disc. `reach` widens the bounds of each point along both coordinates of its normal. Needs at least one point, and
/// one reach per point. Equal results at any number of threads.
[[nodiscard]] ElementTree build_element_tree(std::span<const TreePoint> points, std::span<const float> reach);

}  // namespace footprint
