// See material_table.hpp.
#include "methods/iwasaki_sg/material_table.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "renderer/microgeometry/direction_grid.hpp"

namespace footprint::iwasaki_sg {
namespace {

// Runs a stage and tells the observer how long it took.
template <class Stage>
auto timed(std::string_view name, const StageObserver& observer, const Stage& stage) {
  const auto start = std::chrono::steady_clock::now();
  auto result = stage();
  if (observer) observer(name, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  return result;
}

// How the lobes share what is seen from about straight above: the mean of the grid's central directions.
std::vector<double> shares_from_above(const Amplitudes& table, int side) {
  std::vector<double> shares(table.lobes.size());
  const std::size_t n = table.directions, pairs = n * n;
  const int low = (side - 1) / 2, high = side / 2;
  double total = 0.0;
  for (const int y : {low, high}) {
    for (const int x : {low, high}) {
      const auto d = static_cast<std::size_t>(y * side + x);
      for (std::size_t j = 0; j < shares.size(); ++j) {
        const double mass = table.masses[j * table.channels * pairs + d * n + d];
        shares[j] += mass;
        total += mass;
      }
    }
  }
  for (double& share : shares) share = total > 0.0 ? share / total : 1.0 / static_cast<double>(shares.size());
  return shares;
}

}  // namespace

MaterialTable patch_table(const Patch& patch, const TableSettings& settings, const Progress& progress,
                          const StageObserver& observer) {
  std::vector<glm::dvec3> directions = direction_grid(settings.side);
  BinnedFacets facets = timed("samples", observer,
                              [&] { return bin_facets(patch, sample_facets(patch, settings.facets, settings.seed)); });
  FacetVisibility visibility =
      timed("visibility", observer, [&] { return facet_visibility(patch, facets.samples, directions, progress); });
  const Bvndf bvndf = timed(
      "bvndf", observer, [&] { return make_bvndf(std::move(facets), std::move(visibility), std::move(directions)); });
  const NdfFit ndf = timed("ndf", observer, [&] { return fit_ndf(visible_ndf(bvndf), settings.lobes); });
  const BvndfSums sums = timed("sums", observer, [&] {
    return sum_bvndf(bvndf, ndf.lobes, settings.cosines, settings.channels, settings.paints, progress);
  });
  MaterialTable table;
  table.amplitudes =
      timed("amplitudes", observer, [&] { return solve_amplitudes(bvndf, sums, ndf.lobes, settings.energy); });
  table.shares = shares_from_above(table.amplitudes, settings.side);
  table.normals = bvndf.bins.size();
  double seen = 0.0;
  for (const WeightedNormal& n : visible_ndf(bvndf)) seen += n.weight;
  table.visible_share = seen / bvndf.total_area();
  return table;
}

MaterialTable flat_table(std::span<const WeightedNormal> normals, const TableSettings& settings) {
  const std::vector<glm::dvec3> directions = direction_grid(settings.side);
  const NdfFit ndf = fit_ndf(normals, settings.lobes);
  const std::size_t n = directions.size(), pairs = n * n;
  MaterialTable table;
  table.shares = ndf.shares;
  table.normals = normals.size();
  Amplitudes& out = table.amplitudes;
  out.lobes = ndf.lobes;
  out.directions = n;
  out.channels = settings.channels;
  for (const double share : ndf.shares) {
    out.masses.insert(out.masses.end(), settings.channels * pairs, static_cast<float>(share));
  }
  out.diffuse.resize(settings.channels * pairs);
  for (std::size_t i = 0; i < settings.channels * n; ++i) {
    double sum = 0.0;
    for (const WeightedNormal& normal : normals) {
      sum += normal.weight * std::max(glm::dot(normal.normal, directions[i % n]), 0.0);
    }
    std::fill_n(out.diffuse.begin() + static_cast<std::ptrdiff_t>(i * n), n, static_cast<float>(sum));
  }
  return table;
}

}  // namespace footprint::iwasaki_sg
