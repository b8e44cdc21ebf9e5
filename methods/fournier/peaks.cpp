// Merges sets of normals pair by pair, the cheapest pair first, and pools normals in square cells of Lambert's disc
// that are as wide as the base lobe.
#include "methods/fournier/peaks.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <tuple>

namespace footprint::fournier {
namespace {

// The increase of the variance about the means by a union, from the difference of the means, which does not cancel.
double cost_of_union(const Moments& a, const Moments& b) {
  const double shared = a.weight * b.weight / (a.weight + b.weight);
  return shared * (a.sum / a.weight - b.sum / b.weight).squaredNorm();
}

// Merges the pair whose union costs least into its first set, and removes the second.
void merge_cheapest_pair(std::vector<Moments>& sets) {
  std::size_t first = 0, second = 1;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < sets.size(); ++i) {
    for (std::size_t j = i + 1; j < sets.size(); ++j) {
      const double cost = cost_of_union(sets[i], sets[j]);
      if (cost < least) std::tie(least, first, second) = std::tuple(cost, i, j);
    }
  }
  sets[first].add(sets[second]);
  sets.erase(sets.begin() + static_cast<std::ptrdiff_t>(second));
}

// Indices of the heaviest normals that are `apart` from each other, followed by the heaviest of the others.
std::vector<std::size_t> choose_seeds(const std::vector<Peak>& normals, std::size_t count, double apart) {
  std::vector<std::size_t> order(normals.size()), seeds, near;
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::greater{}, [&](std::size_t i) { return normals[i].weight; });
  for (const std::size_t i : order) {
    const bool is_apart = std::ranges::all_of(
        seeds, [&](std::size_t seed) { return (normals[seed].axis - normals[i].axis).norm() >= apart; });
    (is_apart ? seeds : near).push_back(i);
    if (seeds.size() == count) break;
  }
  for (std::size_t k = 0; seeds.size() < count; ++k) seeds.push_back(near[k]);
  return seeds;
}

// The peak of each set, the heaviest first.
std::vector<Peak> sorted_peaks(const std::vector<Moments>& sets) {
  std::vector<Peak> peaks;
  for (const Moments& set : sets) peaks.push_back(peak_of(set));
  std::ranges::stable_sort(peaks, std::greater{}, &Peak::weight);
  return peaks;
}

constexpr double disc_radius = 2.0;
constexpr double smallest_edge = 1.0 / 16.0;
constexpr double largest_edge = 0.5;

}  // namespace

std::vector<Peak> clustered_peaks(const std::vector<Peak>& normals, std::size_t count, double apart) {
  const std::vector<std::size_t> seeds = choose_seeds(normals, count, apart);
  std::vector<Moments> sets(count);
  for (const Peak& normal : normals) {
    const auto nearest = std::ranges::min_element(
        seeds, {}, [&](std::size_t seed) { return (normals[seed].axis - normal.axis).squaredNorm(); });
    sets[static_cast<std::size_t>(nearest - seeds.begin())].add(moments_of(normal));
  }
  return sorted_peaks(sets);
}

Moments moments_of(const Peak& peak) { return {peak.weight, peak.axis * (peak.weight / (1.0 + peak.spread))}; }

Peak peak_of(const Moments& moments) {
  const double length = moments.sum.norm();
  if (length * (1.0 + largest_spread) <= moments.weight) return {moments.weight, {0.0, 0.0, 1.0}, largest_spread};
  return {moments.weight, moments.sum / length, std::max(moments.weight - length, 0.0) / length};
}

std::vector<Peak> merged_peaks(std::vector<Moments> sets, std::size_t count) {
  std::erase_if(sets, [](const Moments& set) { return set.weight <= 0.0; });
  while (sets.size() > count) merge_cheapest_pair(sets);
  return sorted_peaks(sets);
}

Eigen::Vector2d disc_from_direction(const Eigen::Vector3d& direction) {
  const double below = 1.0 + direction.z();
  if (below < 1e-12) return {2.0, 0.0};
  return direction.head<2>() * std::sqrt(2.0 / below);
}

Eigen::Vector3d direction_from_disc(const Eigen::Vector2d& point) {
  const double quarter = std::min(0.25 * point.squaredNorm(), 1.0);
  const double scale = std::sqrt(1.0 - quarter);
  return {point.x() * scale, point.y() * scale, 1.0 - 2.0 * quarter};
}

NormalCells::NormalCells(double edge)
    : cells_per_unit_(1.0 / edge),
      cells_per_edge_(static_cast<std::uint32_t>(2.0 * disc_radius * cells_per_unit_) + 1) {}

NormalCells NormalCells::of_lobe(double base_variance) {
  return NormalCells(std::clamp(std::sqrt(base_variance), smallest_edge, largest_edge));
}

std::uint32_t NormalCells::cell_of(const Eigen::Vector3d& normal) const {
  const Eigen::Vector2d point = disc_from_direction(normal);
  const auto index = [&](double coordinate) {
    const auto cell = static_cast<std::uint32_t>(std::max((coordinate + disc_radius) * cells_per_unit_, 0.0));
    return std::min(cell, cells_per_edge_ - 1);
  };
  return index(point.y()) * cells_per_edge_ + index(point.x());
}

void unite_cells(NormalBins& bins) {
  const auto key = [](const NormalBin& bin) { return std::pair(bin.group, bin.cell); };
  std::ranges::stable_sort(bins, {}, key);
  auto last = bins.begin();
  for (auto bin = bins.begin(); bin != bins.end(); ++bin) {
    if (bin == last) continue;
    if (key(*bin) == key(*last)) {
      last->moments.add(bin->moments);
    } else {
      *++last = *bin;
    }
  }
  if (last != bins.end()) bins.erase(last + 1, bins.end());
  bins.shrink_to_fit();
}

std::vector<Peak> target_of(const NormalBins& bins, std::span<const double> group_spreads) {
  std::vector<Peak> target;
  target.reserve(bins.size());
  for (const NormalBin& bin : bins) {
    target.push_back(peak_of(bin.moments));
    if (!group_spreads.empty()) target.back().spread += group_spreads[bin.group];
  }
  return target;
}

}  // namespace footprint::fournier
