// Test support for `atanasov_bins`, in double precision: areas under a parallelogram by the inverse bin map's trees, as
// the shader walks them, and by a plain loop over texels that shares no code with them; and draws of normals.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "methods/atanasov_bins/inverse_map.hpp"
#include "renderer/microgeometry/direction_grid.hpp"
#include "renderer/scene/material.hpp"

namespace footprint::testing {

/// A pixel's footprint on the map: centre and edges (columns) in texels.
struct Parallelogram {
  glm::dvec2 centre{0.0};
  glm::dmat2 edges{1.0};

  [[nodiscard]] double area() const { return std::abs(glm::determinant(edges)); }
  [[nodiscard]] glm::dvec2 reach() const { return 0.5 * (glm::abs(edges[0]) + glm::abs(edges[1])); }
};

/// The area of [lower, upper] under a parallelogram: its polygon is clipped by the four sides in turn.
[[nodiscard]] inline double clipped_area(const Parallelogram& p, const glm::dvec2& lower, const glm::dvec2& upper) {
  const glm::dvec2 a = p.centre - 0.5 * (p.edges[0] + p.edges[1]);
  std::vector<glm::dvec2> polygon{a, a + p.edges[0], a + p.edges[0] + p.edges[1], a + p.edges[1]};
  for (int side = 0; side < 4; ++side) {
    const int axis = side % 2;
    const double sign = side < 2 ? 1.0 : -1.0;
    const double bound = side < 2 ? lower[axis] : upper[axis];
    const auto inside = [&](const glm::dvec2& v) { return sign * (v[axis] - bound); };
    std::vector<glm::dvec2> cut;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const glm::dvec2 from = polygon[i], to = polygon[(i + 1) % polygon.size()];
      if (inside(from) >= 0.0) cut.push_back(from);
      if (inside(from) * inside(to) < 0.0)
        cut.push_back(from + (to - from) * (inside(from) / (inside(from) - inside(to))));
    }
    polygon = cut;
  }
  double twice = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2 from = polygon[i] - a, to = polygon[(i + 1) % polygon.size()] - a;
    twice += from.x * to.y - from.y * to.x;
  }
  return 0.5 * std::abs(twice);
}

/// The bin of a unit vector among m x m, by the unit square without packing. A direction below the horizon is in the
/// nearest bin of the rim.
[[nodiscard]] inline std::uint32_t bin_of(const glm::dvec3& direction, int m) {
  const glm::ivec2 at = glm::clamp(glm::ivec2(glm::floor(hemisphere_to_square(direction) * double(m))), 0, m - 1);
  return static_cast<std::uint32_t>(at.y * m + at.x);
}

/// The texel of the map (0 to size - 1) at texel `i` of any copy of it.
[[nodiscard]] inline int wrapped(int i, int size, Wrap wrap) {
  if (wrap == Wrap::clamp_to_edge) return std::clamp(i, 0, size - 1);
  const int period = wrap == Wrap::repeat ? size : 2 * size;
  const int at = (i % period + period) % period;
  return at < size ? at : period - 1 - at;
}

/// Calls function(x, y, area) for every texel under a parallelogram, with the area of the texel that is covered.
template <class Function>
void for_each_texel(const Parallelogram& p, const glm::ivec2& size, Wrap wrap, const Function& function) {
  const glm::ivec2 first(glm::floor(p.centre - p.reach())), end(glm::ceil(p.centre + p.reach()));
  for (int y = first.y; y < end.y; ++y) {
    for (int x = first.x; x < end.x; ++x) {
      const double area = clipped_area(p, glm::dvec2(x, y), glm::dvec2(x + 1, y + 1));
      if (area > 0.0) function(wrapped(x, size.x, wrap), wrapped(y, size.y, wrap), area);
    }
  }
}

/// Section 2.1: draws a normal under a parallelogram by four numbers of [0, 1). The first two are a point in it, the
/// others a place in the bin of that point's texel. None if the texel has no normal.
[[nodiscard]] inline std::optional<glm::dvec3> drawn_normal(const atanasov_bins::BinMap& map, const Parallelogram& p,
                                                            Wrap wrap, const glm::dvec4& u) {
  const glm::ivec2 at(glm::floor(p.centre + p.edges * (glm::dvec2(u) - 0.5)));
  const int x = wrapped(at.x, map.width, wrap), y = wrapped(at.y, map.height, wrap);
  const std::uint32_t packed = map.normals[static_cast<std::size_t>(y * map.width + x)];
  if (packed == atanasov_bins::no_normal) return std::nullopt;
  const auto across = static_cast<std::uint32_t>(map.across);
  const std::uint32_t bin = atanasov_bins::bin_of_packed(packed, map.across);
  const glm::dvec2 cell(bin % across, bin / across);
  return square_to_hemisphere((cell + glm::dvec2(u.z, u.w)) / static_cast<double>(across));
}

/// Walks the inverse map's trees: the area of a list's texels under a parallelogram, within one copy of the map.
class WalkTwin {
 public:
  WalkTwin(const atanasov_bins::InverseMap& map, const Parallelogram& p) : map_(&map), p_(p) {}

  [[nodiscard]] double area(std::size_t list) {
    return node(map_->lists[list].root, map_->lists[list].first, map_->lists[list].first + map_->count_of(list),
                {{0, 0}, {map_->width, map_->height}});
  }
  [[nodiscard]] std::size_t nodes_visited() const { return visited_; }

 private:
  [[nodiscard]] double node(std::uint32_t at, std::uint32_t first, std::uint32_t end,
                            const atanasov_bins::TexelRect& rect) {
    if (first == end) return 0.0;
    ++visited_;
    const glm::dvec2 sides(rect.upper - rect.lower);
    const double covered = clipped_area(p_, rect.lower, rect.upper);
    if (covered <= 0.0) return 0.0;
    if (covered >= sides.x * sides.y * (1.0 - 1e-12)) return end - first;
    if (end - first <= atanasov_bins::leaf_size) {
      double sum = 0.0;
      for (std::uint32_t i = first; i < end; ++i) {
        const glm::dvec2 texel(map_->texels[i] & 0xFFFFU, map_->texels[i] >> 16U);
        sum += clipped_area(p_, texel, texel + 1.0);
      }
      return sum;
    }
    const atanasov_bins::Halves halves = atanasov_bins::halves_of(rect);
    atanasov_bins::TexelRect lower = rect, upper = rect;
    (halves.along_x ? lower.upper.x : lower.upper.y) = halves.middle;
    (halves.along_x ? upper.lower.x : upper.lower.y) = halves.middle;
    const atanasov_bins::Branches branches = atanasov_bins::branches_of(map_->forest, at, first, end);
    return node(branches.lower, first, branches.upper_first, lower) +
           node(branches.upper, branches.upper_first, end, upper);
  }

  const atanasov_bins::InverseMap* map_;
  Parallelogram p_;
  std::size_t visited_ = 0;
};

}  // namespace footprint::testing
