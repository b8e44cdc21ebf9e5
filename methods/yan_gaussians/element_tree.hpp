// A hierarchy over points of position and normal: a complete binary tree, walked without a stack.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace footprint {

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
