// Runs the stages one after the other: samples, visibility, BVNDF, NDF, amplitudes.
#include "methods/iwasaki_sg/material_table.hpp"

#include <algorithm>
#include <utility>

#include "renderer/bake/facets.hpp"
#include "renderer/microgeometry/direction_grid.hpp"
#include "renderer/microgeometry/microgeometry.hpp"

namespace footprint::iwasaki_sg {
namespace {

// The shares of the lobes in the area visible from about straight above: the mean over the central directions of the
// grid.
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

std::vector<OptionSpec> option_table() {
  return {
      whole_option("j", 7, 1, most_lobes,
                   "Most spherical Gaussians of the normal distribution; 3 and 7 fill texels of four with the "
                   "diffuse term."),
      whole_option("directions", 12, 2, 32, "Side of the grid of incident and outgoing directions."),
      whole_option("facets", 65536, 64, 1 << 24, "Samples of the patch."),
      word_option("lobe", {"base", "sg"},
                  "What a lobe of normals reflects with: the scene's base lobe, widened by that of the normals, or "
                  "the paper's spherical Gaussians, one or several fitted to the base lobe."),
      word_option("convolution", {"approximate", "exact"},
                  "lobe=sg: the convolution of two spherical Gaussians as one (Eq. 14), or exactly (Eq. 11)."),
      word_option("cosines", {"base", "published"},
                  "What facets weigh in the specular term: (n.wo), with the base BRDF's own cosine and geometry "
                  "term, or the paper's (n.wi)(n.wo) without a geometry term."),
      word_option("energy", {"conserved", "published", "any_sign"},
                  "Whether the amplitudes are scaled to the energy of the visible facets; least squares, as in the "
                  "paper, do not conserve it, and without a bound amplitudes may be below 0."),
      word_option("environment", {"irradiance", "gaussians"},
                  "What the diffuse term receives from an environment: its prefiltered irradiance, or the paper's nine "
                  "spherical Gaussians fitted to it. Tabulated BRDFs have the first."),
      word_option("storage", {"fp32", "fp16"}, "How the amplitudes are stored: 32-bit or 16-bit floats.")};
}

bool is_tabulated(const Material& material) { return material.microgeometry && material.microgeometry->brdf; }

EffectSet patch_effects(const Material& material) {
  EffectSet effects;
  if (!material.microgeometry) return effects;
  effects.set(static_cast<std::size_t>(Effect::microgeometry_visibility));
  effects.set(static_cast<std::size_t>(Effect::microgeometry_colour), needs_colors(*material.microgeometry));
  effects.set(static_cast<std::size_t>(Effect::tabulated_brdf), is_tabulated(material));
  return effects;
}

TableSettings table_settings(const Material& material, const Options& options, const EffectSet& effects) {
  return {
      .lobes = static_cast<int>(options.number("j")),
      .side = static_cast<int>(options.number("directions")),
      .facets = static_cast<std::size_t>(options.number("facets")),
      .cosines = options.word("cosines") == "published" || is_tabulated(material) ? Cosines::published : Cosines::base,
      .energy = options.word("energy") == "conserved"   ? Energy::conserved
                : options.word("energy") == "published" ? Energy::published
                                                        : Energy::any_sign,
      .channels = has(effects, Effect::microgeometry_colour) ? std::size_t{3} : std::size_t{1},
      .paints = paint_factors(material)};
}

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
