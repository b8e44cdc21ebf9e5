// Builds the elements of a normal map, and splits them at medians into a complete binary tree.
#include "methods/yan_gaussians/elements.hpp"

#include <tbb/parallel_invoke.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "renderer/bake/material_maps.hpp"
#include "renderer/image/mipmap.hpp"

namespace footprint {
namespace {

// The mean of valid normals over (x, y), of the finest level that has one.
std::span<const float> valid_mean(const std::vector<Image>& chain, int x, int y) {
  const Image& finest = chain.front();
  for (const Image& level : chain) {
    const auto texel = level.at(static_cast<int>(static_cast<std::int64_t>(x) * level.width / finest.width),
                                static_cast<int>(static_cast<std::int64_t>(y) * level.height / finest.height));
    const float size = std::hypot(texel[0], texel[1], texel[2]);
    if (texel[3] > 0.0F && size > 1e-3F) return texel;
  }
  return {};
}

// Normals of unit length and weight 1.
Image filled(const Image& normals) {
  std::vector<Image> chain{normals};
  bool holes = false;
  for (std::size_t i = 3; i < normals.texels.size(); i += 4) holes = holes || normals.texels[i] <= 0.0F;
  if (holes) chain = weighted_mip_chain(normals);
  Image out(normals.width, normals.height, 4, 1.0F);
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      const auto mean = valid_mean(chain, x, y);
      const glm::vec3 normal = mean.empty() ? glm::vec3(0, 0, 1) : glm::normalize(glm::vec3(mean[0], mean[1], mean[2]));
      std::copy_n(&normal.x, 3, out.at(x, y).begin());
    }
  }
  return out;
}

// Appends the mirror image along each axis that does not repeat.
Image unfolded(const Image& map, const std::array<Wrap, 2>& wrap) {
  const bool along_u = wrap[0] != Wrap::repeat, along_v = wrap[1] != Wrap::repeat;
  Image out(map.width * (along_u ? 2 : 1), map.height * (along_v ? 2 : 1), map.channels);
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      const int from_x = x < map.width ? x : 2 * map.width - 1 - x,
                from_y = y < map.height ? y : 2 * map.height - 1 - y;
      std::ranges::copy(map.at(from_x, from_y), out.at(x, y).begin());
    }
  }
  return out;
}

std::array<float, 4> jacobian_at(const Image& normals, int x, int y) {
  const auto left = normals.at((x + normals.width - 1) % normals.width, y);
  const auto right = normals.at((x + 1) % normals.width, y);
  const auto before = normals.at(x, (y + normals.height - 1) % normals.height);
  const auto behind = normals.at(x, (y + 1) % normals.height);
  return {0.5F * (right[0] - left[0]), 0.5F * (behind[0] - before[0]), 0.5F * (right[1] - left[1]),
          0.5F * (behind[1] - before[1])};
}

class Builder {
 public:
  Builder(std::span<const TreePoint> points, std::span<const float> reach, ElementTree& tree)
      : points_(points), reach_(reach), tree_(tree) {}

  /// Node `place` of `level`, counted from the left.
  void build(int level, std::size_t place) const {
    const std::size_t node = (std::size_t{1} << level) + place;
    const std::size_t leaf = place << (tree_.depth - level), next = (place + 1) << (tree_.depth - level);
    const std::span<std::uint32_t> points =
        std::span(tree_.order).subspan(tree_.leaf_begin(leaf), tree_.leaf_begin(next) - tree_.leaf_begin(leaf));
    if (level == tree_.depth) {
      tree_.nodes[node] = bounds(points, true);
      return;
    }
    const std::size_t left = tree_.leaf_begin((leaf + next) / 2) - tree_.leaf_begin(leaf);
    split(points, left, widest(bounds(points, false)));
    const auto half = [&](std::size_t child) { build(level + 1, 2 * place + child); };
    if (points.size() > 4096) {
      tbb::parallel_invoke([&] { half(0); }, [&] { half(1); });
    } else {
      half(0);
      half(1);
    }
    tree_.nodes[node] = joined(tree_.nodes[2 * node], tree_.nodes[2 * node + 1]);
  }

 private:
  [[nodiscard]] TreeBounds bounds(std::span<const std::uint32_t> points, bool with_reach) const {
    TreeBounds out;
    out.low.fill(std::numeric_limits<float>::max());
    out.high.fill(std::numeric_limits<float>::lowest());
    for (const std::uint32_t point : points) {
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

  void split(std::span<std::uint32_t> points, std::size_t left, std::size_t axis) const {
    std::nth_element(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(left), points.end(),
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

Elements make_elements(const Material& material, bool jacobians) {
  Elements elements{.normals = unfolded(filled(normal_map_of(material)), normal_coordinates(material).wrap)};
  if (!jacobians) return elements;
  elements.jacobians = elements.normals;
  for (int y = 0; y < elements.normals.height; ++y) {
    for (int x = 0; x < elements.normals.width; ++x)
      std::ranges::copy(jacobian_at(elements.normals, x, y), elements.jacobians.at(x, y).begin());
  }
  return elements;
}

float normal_reach(const Elements& elements, std::size_t texel) {
  if (elements.jacobians.empty()) return 0.0F;
  const float* const by = &elements.jacobians.texels[4 * texel];
  const glm::dvec2 disc(elements.normals.texels[4 * texel], elements.normals.texels[4 * texel + 1]);
  const auto height = [](const glm::dvec2& at) { return std::sqrt(std::max(1.0 - glm::dot(at, at), 0.0)); };
  double squares = 0.0;
  for (const glm::dvec2 slope : {glm::dvec2(by[0], by[2]), glm::dvec2(by[1], by[3])}) {
    const double rise = 0.5 * (height(disc + slope) - height(disc - slope));
    squares += glm::dot(slope, slope) + rise * rise;
  }
  return static_cast<float>(seed_deviation * std::sqrt(squares));
}

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
