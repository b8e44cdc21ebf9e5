// Pools normals in square cells of the disc that they map to, as wide as the base lobe.
#include "methods/fournier/normal_bins.hpp"

#include <algorithm>
#include <cmath>

namespace footprint::fournier {
namespace {

constexpr double disc_radius = 2.0;
constexpr double smallest_edge = 1.0 / 16.0;
constexpr double largest_edge = 0.5;

}  // namespace

NormalCells::NormalCells(double base_variance)
    : cells_per_unit_(1.0 / std::clamp(std::sqrt(base_variance), smallest_edge, largest_edge)),
      cells_per_edge_(static_cast<std::uint32_t>(2.0 * disc_radius * cells_per_unit_) + 1) {}

std::uint32_t NormalCells::cell_of(const Eigen::Vector3d& normal) const {
  const Eigen::Vector2d point = disc_from_direction(normal);
  const auto index = [&](double coordinate) {
    const auto cell = static_cast<std::uint32_t>(std::max((coordinate + disc_radius) * cells_per_unit_, 0.0));
    return std::min(cell, cells_per_edge_ - 1);
  };
  return index(point.y()) * cells_per_edge_ + index(point.x());
}

void unite_cells(NormalBins& bins) {
  std::ranges::stable_sort(bins, {}, &NormalBin::cell);
  auto last = bins.begin();
  for (auto bin = bins.begin(); bin != bins.end(); ++bin) {
    if (bin == last) continue;
    if (bin->cell == last->cell) {
      last->moments.add(bin->moments);
    } else {
      *++last = *bin;
    }
  }
  if (last != bins.end()) bins.erase(last + 1, bins.end());
  bins.shrink_to_fit();
}

std::vector<Peak> target_of(const NormalBins& bins) {
  std::vector<Peak> target;
  target.reserve(bins.size());
  for (const NormalBin& bin : bins) target.push_back(peak_of(bin.moments));
  return target;
}

}  // namespace footprint::fournier
