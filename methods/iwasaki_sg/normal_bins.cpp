// Sorts facets and the texels of a normal map into the cells of a cube.
#include "methods/iwasaki_sg/normal_bins.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace footprint::iwasaki_sg {
namespace {

struct Cell {
  glm::dvec3 sum{0.0};
  double weight = 0.0;
};

// What fell in the cells of a cube, in their order.
class CubeSums {
 public:
  explicit CubeSums(int side) : side_(side), cells_(std::size_t{6} * static_cast<std::size_t>(side * side)) {}

  // `mean` need not be of unit length; its direction says the cell.
  void add(const glm::dvec3& mean, double weight) {
    Cell& cell = cells_[cube_cell(mean, side_)];
    cell.sum += weight * mean;
    cell.weight += weight;
  }

  [[nodiscard]] std::vector<WeightedNormal> normals() const {
    std::vector<WeightedNormal> out;
    for (const Cell& cell : cells_) {
      if (cell.weight > 0.0) out.push_back({cell.sum / cell.weight, cell.weight});
    }
    return out;
  }

 private:
  int side_;
  std::vector<Cell> cells_;
};

}  // namespace

std::uint32_t cube_cell(const glm::dvec3& normal, int side) {
  const glm::dvec3 size = glm::abs(normal);
  int axis = size.x >= size.y ? 0 : 1;
  if (size.z >= size[axis]) axis = 2;
  const double lead = std::max(size[axis], 1e-300);
  const auto cell_along = [&](int other) {
    // The hair keeps normals on an axis, which lies on a border of cells, together whatever rounding does to them.
    constexpr double hair = 1e-6;
    const double unit = 0.5 + 0.5 * normal[other] / lead + hair;
    return std::min(static_cast<int>(unit * side), side - 1);
  };
  const int face = 2 * axis + (normal[axis] < 0.0 ? 1 : 0);
  return static_cast<std::uint32_t>((face * side + cell_along((axis + 2) % 3)) * side + cell_along((axis + 1) % 3));
}

BinnedFacets bin_facets(const Patch& patch, const FacetSamples& samples) {
  struct Key {
    std::uint32_t paint, cell, sample;
    [[nodiscard]] bool same_bin(const Key& other) const { return paint == other.paint && cell == other.cell; }
    auto operator<=>(const Key&) const = default;
  };
  std::vector<glm::dvec3> normals;
  std::vector<Key> of_triangle;
  for (std::size_t t = 0; t < patch.triangles.size(); ++t) {
    normals.push_back(facet_plane(patch, t).normal);
    of_triangle.push_back({patch.paints.empty() ? 0U : patch.paints[t], cube_cell(normals[t], cube_side), 0});
  }
  std::vector<Key> keys;
  keys.reserve(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    keys.push_back(of_triangle[samples.triangles[i]]);
    keys.back().sample = static_cast<std::uint32_t>(i);
  }
  std::ranges::sort(keys);
  BinnedFacets out;
  out.samples.facet_area = samples.facet_area;
  glm::dvec3 sum(0.0);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const std::uint32_t triangle = samples.triangles[keys[i].sample];
    if (i == 0 || !keys[i].same_bin(keys[i - 1])) {
      out.bins.push_back({{}, static_cast<std::uint8_t>(keys[i].paint), i, i});
      sum = glm::dvec3(0.0);
    }
    sum += normals[triangle];
    out.bins.back().end = i + 1;
    out.bins.back().normal = glm::normalize(sum);
    out.samples.positions.push_back(samples.positions[keys[i].sample]);
    out.samples.triangles.push_back(triangle);
  }
  return out;
}

std::vector<WeightedNormal> bin_normal_map(const Image& normals) {
  CubeSums sums(cube_side);
  double total = 0.0;
  for (std::size_t i = 0; i + 3 < normals.texels.size(); i += 4) {
    const glm::dvec3 n(normals.texels[i], normals.texels[i + 1], normals.texels[i + 2]);
    const double weight = normals.texels[i + 3];
    const double length = glm::length(n);
    if (!(weight > 0.0 && length > 1e-3)) continue;
    sums.add(n / length, weight);
    total += weight;
  }
  std::vector<WeightedNormal> out = sums.normals();
  for (WeightedNormal& normal : out) normal.weight /= total;
  return out;
}

std::vector<WeightedNormal> pool_normals(std::vector<WeightedNormal> normals, std::size_t most) {
  for (int side = cube_side / 2; normals.size() > most && side > 0; side /= 2) {
    CubeSums sums(side);
    for (const WeightedNormal& n : normals) sums.add(n.normal, n.weight);
    normals = sums.normals();
  }
  return normals;
}

}  // namespace footprint::iwasaki_sg
