// Medians by std::nth_element, subtrees in parallel; points of one coordinate are in the order of their numbers, so
// that the tree is the same at any number of threads.
#include "methods/yan_gaussians/element_tree.hpp"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace footprint {
namespace {

class Builder {
 public:
  Builder(std::span<const TreePoint> points, std::span<const float> reach, ElementTree& tree)
      : points_(points), reach_(reach), tree_(tree) {}

  /// Node `place` of `level`, counted from the left.
  void build(int level, std::size_t place) const {
    const std::size_t node = (std::size_t{1} << level) + place;
    const std::size_t leaf = place << (tree_.depth - level), next = (place + 1) << (tree_.depth - level);
    const std::span<std::uint32_t> held =
        std::span(tree_.order).subspan(tree_.leaf_begin(leaf), tree_.leaf_begin(next) - tree_.leaf_begin(leaf));
    if (level == tree_.depth) {
      tree_.nodes[node] = bounds(held, true);
      return;
    }
    const std::size_t left = tree_.leaf_begin((leaf + next) / 2) - tree_.leaf_begin(leaf);
    split(held, left, widest(bounds(held, false)));
    const auto half = [&](std::size_t child) { build(level + 1, 2 * place + child); };
    if (held.size() > 4096) {
      tbb::parallel_invoke([&] { half(0); }, [&] { half(1); });
    } else {
      half(0);
      half(1);
    }
    tree_.nodes[node] = joined(tree_.nodes[2 * node], tree_.nodes[2 * node + 1]);
  }

 private:
  [[nodiscard]] TreeBounds bounds(std::span<const std::uint32_t> held, bool with_reach) const {
    TreeBounds out;
    out.low.fill(std::numeric_limits<float>::max());
    out.high.fill(std::numeric_limits<float>::lowest());
    for (const std::uint32_t point : held) {
      for (std::size_t axis = 0; axis < 4; ++axis) {
        const float reach = with_reach && axis >= 2 ? reach_[point] : 0.0F;
        out.low[axis] = std::min(out.low[axis], points_[point][axis] - reach);
        out.high[axis] = std::max(out.high[axis], points_[point][axis] + reach);
      }
    }
    return out;
  }

  static std::size_t widest(const TreeBounds& bounds) {
    std::size_t widest = 0;
    const auto extent = [&](std::size_t axis) {
      return (axis < 2 ? 1.0F : 0.5F) * (bounds.high[axis] - bounds.low[axis]);  // the disc is two wide
    };
    for (std::size_t axis = 1; axis < 4; ++axis) widest = extent(axis) > extent(widest) ? axis : widest;
    return widest;
  }

  void split(std::span<std::uint32_t> held, std::size_t left, std::size_t axis) const {
    std::nth_element(held.begin(), held.begin() + static_cast<std::ptrdiff_t>(left), held.end(),
                     [&](std::uint32_t a, std::uint32_t b) {
                       return points_[a][axis] != points_[b][axis] ? points_[a][axis] < points_[b][axis] : a < b;
                     });
  }

  static TreeBounds joined(const TreeBounds& a, const TreeBounds& b) {
    TreeBounds out;
    for (std::size_t axis = 0; axis < 4; ++axis) {
      out.low[axis] = std::min(a.low[axis], b.low[axis]);
      out.high[axis] = std::max(a.high[axis], b.high[axis]);
    }
    return out;
  }

  std::span<const TreePoint> points_;
  std::span<const float> reach_;
  ElementTree& tree_;
};

}  // namespace

ElementTree build_element_tree(std::span<const TreePoint> points, std::span<const float> reach) {
  ElementTree tree;
  while (points.size() > (ElementTree::most_in_leaf << tree.depth)) ++tree.depth;
  tree.order.resize(points.size());
  std::iota(tree.order.begin(), tree.order.end(), 0U);
  tree.nodes.resize(std::size_t{2} << tree.depth);
  Builder(points, reach, tree).build(0, 0);
  return tree;
}

}  // namespace footprint
