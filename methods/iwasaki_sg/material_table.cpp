// Runs the stages from samples to amplitudes, and weighs the lobes by what of each is seen from above.
#include "methods/iwasaki_sg/material_table.hpp"

#include <algorithm>
#include <utility>

#include "renderer/microgeometry/direction_grid.hpp"

namespace footprint::iwasaki_sg {
namespace {

// How the lobes share what is seen from about straight above: the mean of the grid's central directions.
std::vector<double> shares_from_above(const Amplitudes& table, int side) {
  std::vector<double> shares(table.lobes.size());
  const std::size_t n = table.directions, pairs = n * n;
  const auto row = static_cast<std::size_t>(side);
  const std::size_t low = (row - 1) / 2, high = row / 2;
  double total = 0.0;
  for (const std::size_t y : {low, high}) {
    for (const std::size_t x : {low, high}) {
      const std::size_t d = y * row + x;
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

Bvndf patch_bvndf(const Patch& patch, const TableSettings& settings, const Progress& progress) {
  ProgressParts parts(progress, 10.0);  // weights: about the share of the time
  parts.next(1.0, "")("samples", 0.0);
  std::vector<glm::dvec3> directions = direction_grid(settings.side);
  BinnedFacets facets = bin_facets(patch, sample_facets(patch, settings.facets, settings.seed));
  FacetVisibility visibility = facet_visibility(patch, facets.samples, directions, parts.next(8.0, ""));
  parts.next(1.0, "")("BVNDF", 0.0);
  return make_bvndf(std::move(facets), std::move(visibility), std::move(directions));
}

MaterialTable patch_table(const Patch& patch, const TableSettings& settings, const Progress& progress) {
  ProgressParts parts(progress, 10.0);
  const Bvndf bvndf = patch_bvndf(patch, settings, parts.next(4.0, ""));
  parts.next(0.5, "")("NDF", 0.0);
  const NdfFit ndf = fit_ndf(visible_ndf(bvndf), settings.lobes);
  const BvndfSums sums =
      sum_bvndf(bvndf, ndf.lobes, settings.cosines, settings.channels, settings.paints, parts.next(5.0, ""));
  parts.next(0.5, "")("amplitudes", 0.0);
  MaterialTable table;
  table.amplitudes = solve_amplitudes(bvndf, sums, ndf.lobes, settings.energy);
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
  const std::size_t n = directions.size();
  MaterialTable table;
  table.shares = ndf.shares;
  table.normals = normals.size();
  Amplitudes& out = table.amplitudes;
  out.lobes = ndf.lobes;
  out.directions = n;
  out.channels = settings.channels;
  for (std::size_t j = 0; j < ndf.lobes.size(); ++j) {
    for (std::size_t i = 0; i < settings.channels * n; ++i) {
      const double cosine = std::max(glm::dot(ndf.lobes[j].axis, directions[i % n]), 0.0);
      const double mass = ndf.shares[j] * (settings.cosines == Cosines::published ? cosine : 1.0);
      out.masses.insert(out.masses.end(), n, static_cast<float>(mass));
    }
  }
  out.diffuse.resize(settings.channels * n * n);
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
