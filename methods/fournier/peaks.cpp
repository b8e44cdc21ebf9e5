// Merges sets of normals pair by pair, the cheapest pair first, and pools normals in square cells of Lambert's disc
// that are as wide as the base lobe.
#include "methods/fournier/peaks.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

namespace footprint::fournier {
namespace {

// The increase of the variance about the means by the union of two sets. Computed from the difference of the means, so
// that it does not cancel.
double cost_of_union(const Moments& a, const Moments& b) {
  const double shared = a.weight * b.weight / (a.weight + b.weight);
  return shared * (a.sum / a.weight - b.sum / b.weight).squaredNorm();
}

struct Partner {
  double cost = std::numeric_limits<double>::infinity();
  std::size_t index = 0;
};

// The cheapest partner of set i among those after it.
Partner cheapest_after(const std::vector<Moments>& sets, std::size_t i) {
  Partner best;
  for (std::size_t j = i + 1; j < sets.size(); ++j) {
    if (sets[j].weight <= 0.0) continue;
    const double cost = cost_of_union(sets[i], sets[j]);
    if (cost < best.cost) best = {cost, j};
  }
  return best;
}

// Merges the cheapest pair into its first set, gives the second weight 0, and updates the partners of the sets before
// them.
void merge_cheapest_pair(std::vector<Moments>& sets, std::vector<Partner>& partners) {
  const auto i = static_cast<std::size_t>(std::ranges::min_element(partners, {}, &Partner::cost) - partners.begin());
  const std::size_t gone = partners[i].index;
  sets[i].add(sets[gone]);
  sets[gone] = {};
  partners[gone] = {};
  for (std::size_t k = 0; k < gone; ++k) {
    if (sets[k].weight <= 0.0) continue;
    if (k == i || partners[k].index == i || partners[k].index == gone) {
      partners[k] = cheapest_after(sets, k);
    } else if (k < i) {
      const double cost = cost_of_union(sets[k], sets[i]);
      if (cost < partners[k].cost) partners[k] = {cost, i};
    }
  }
}

// Indices sorted by weight, heaviest first; equal weights keep their order.
std::vector<std::size_t> by_weight(const std::vector<Peak>& normals) {
  std::vector<std::size_t> order(normals.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::greater{}, [&](std::size_t i) { return normals[i].weight; });
  return order;
}

// Indices of the heaviest normals that are `apart` from each other, followed by the heaviest of the others.
std::vector<std::size_t> seeds_of(const std::vector<Peak>& normals, std::size_t count, double apart) {
  std::vector<std::size_t> seeds, near;
  for (const std::size_t i : by_weight(normals)) {
    const bool is_apart = std::ranges::all_of(
        seeds, [&](std::size_t seed) { return (normals[seed].axis - normals[i].axis).norm() >= apart; });
    (is_apart ? seeds : near).push_back(i);
    if (seeds.size() == count) break;
  }
  for (std::size_t k = 0; seeds.size() < count; ++k) seeds.push_back(near[k]);
  return seeds;
}

constexpr double disc_radius = 2.0;
constexpr double smallest_edge = 1.0 / 16.0;
constexpr double largest_edge = 0.5;

}  // namespace

std::vector<Peak> clustered_peaks(const std::vector<Peak>& normals, std::size_t count, double apart) {
  const std::vector<std::size_t> seeds = seeds_of(normals, count, apart);
  std::vector<Moments> sets(count);
  for (const Peak& normal : normals) {
    const auto nearest = std::ranges::min_element(
        seeds, {}, [&](std::size_t seed) { return (normals[seed].axis - normal.axis).squaredNorm(); });
    sets[static_cast<std::size_t>(nearest - seeds.begin())].add(moments_of(normal));
  }
  std::vector<Peak> peaks;
  for (const Moments& set : sets) peaks.push_back(peak_of(set));
  std::ranges::stable_sort(peaks, std::greater{}, &Peak::weight);
  return peaks;
}

Moments moments_of(const Peak& peak) { return {peak.weight, peak.axis * (peak.weight / (1.0 + peak.spread))}; }

Peak peak_of(const Moments& moments) {
  const double length = moments.sum.norm();
  if (length * (1.0 + largest_spread) <= moments.weight) return {moments.weight, {0.0, 0.0, 1.0}, largest_spread};
  return {moments.weight, moments.sum / length, std::max(moments.weight - length, 0.0) / length};
}

std::vector<Peak> merged_peaks(std::vector<Moments> sets, std::size_t count) {
  const auto is_empty = [](const Moments& set) { return set.weight <= 0.0; };
  std::erase_if(sets, is_empty);
  if (sets.size() > count) {
    std::vector<Partner> partners;
    for (std::size_t i = 0; i < sets.size(); ++i) partners.push_back(cheapest_after(sets, i));
    for (std::size_t left = sets.size(); left > count; --left) merge_cheapest_pair(sets, partners);
    std::erase_if(sets, is_empty);
  }
  std::vector<Peak> peaks;
  peaks.reserve(sets.size());
  for (const Moments& set : sets) peaks.push_back(peak_of(set));
  std::ranges::stable_sort(peaks, std::greater{}, &Peak::weight);
  return peaks;
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
