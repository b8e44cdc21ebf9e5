// Runs the stages one after the other: samples, visibility, BVNDF, NDF, amplitudes.
#include "methods/iwasaki_sg/material_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "methods/iwasaki_sg/spherical_gaussian.hpp"
#include "renderer/bake/facets.hpp"
#include "renderer/bake/material_maps.hpp"
#include "renderer/microgeometry/direction_grid.hpp"
#include "renderer/microgeometry/microgeometry.hpp"

namespace footprint::iwasaki_sg {
namespace {

// The shares of the lobes in the area visible from about straight above: the mean over the central directions of the
// grid.
std::vector<double> shares_from_above(const Amplitudes& table, int side) {
  std::vector<double> shares(table.lobes.size());
  const auto row = static_cast<std::size_t>(side);
  const std::size_t low = (row - 1) / 2, high = row / 2;
  double total = 0.0;
  for (const std::size_t y : {low, high}) {
    for (const std::size_t x : {low, high}) {
      const std::size_t d = y * row + x;
      for (std::size_t j = 0; j < shares.size(); ++j) {
        const double mass = table.mass(j, 0, d, d);
        shares[j] += mass;
        total += mass;
      }
    }
  }
  for (double& share : shares) share = total > 0.0 ? share / total : 1.0 / static_cast<double>(shares.size());
  return shares;
}

// Row 0: axis and sharpness of each lobe. Row 1: its share of the normals.
PrefilteredTexture lobe_texture(std::span<const SphericalGaussian> lobes, std::span<const double> shares) {
  std::vector<glm::vec4> texels;
  for (const SphericalGaussian& lobe : lobes) texels.push_back(lobe_texel(lobe));
  for (const double share : shares) texels.emplace_back(static_cast<float>(share), 0.0F, 0.0F, 0.0F);
  return make_texture("iwasaki_lobes", {texel_rows(lobes.size(), texels)}, Storage::fp32, {});
}

// Whether a table includes the facets' cosine to the light.
enum class Irradiance { without, with };

// Arranges [channel][wi][wo] as tiles: one for each cell of wo, with one texel for each cell of wi. Values with a
// cosine to the light are divided by that of the whole surface. The ratio is smooth down to the horizon, and 1 for a
// plane.
Image tiled(std::span<const float> values, std::size_t channels, int side, Irradiance irradiance) {
  const std::vector<glm::dvec3> directions = direction_grid(side);
  Image image(side * side, side * side, static_cast<int>(channels));
  const auto n = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
  const auto row = static_cast<std::size_t>(side);
  for (std::size_t wi = 0; wi < n; ++wi) {
    for (std::size_t wo = 0; wo < n; ++wo) {
      const auto x = static_cast<int>(wo % row * row + wi % row);
      const auto y = static_cast<int>(wo / row * row + wi / row);
      const float scale = irradiance == Irradiance::with ? static_cast<float>(1.0 / directions[wi].z) : 1.0F;
      for (std::size_t c = 0; c < channels; ++c) image.at(x, y)[c] = values[(c * n + wi) * n + wo] * scale;
    }
  }
  return image;
}

// Packs one-channel images into images of four channels, which a shader fetches together. Unused channels are 0.
std::vector<Image> packed(const std::vector<Image>& values) {
  std::vector<Image> out;
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (k % 4 == 0) out.emplace_back(values[k].width, values[k].height, 4);
    for (std::size_t i = 0; i < values[k].texels.size(); ++i) out.back().texels[4 * i + k % 4] = values[k].texels[i];
  }
  return out;
}

// The values of the lobes, followed by the diffuse term: one layer each in colour, otherwise four per layer.
PrefilteredTexture amplitude_texture(const Amplitudes& table, const TableSettings& settings, Storage storage) {
  const Irradiance irradiance = settings.cosines == Cosines::published ? Irradiance::with : Irradiance::without;
  const std::size_t size = table.channels * table.directions * table.directions;
  std::vector<Image> values;
  values.reserve(table.lobes.size() + 1);
  for (std::size_t j = 0; j < table.lobes.size(); ++j) {
    values.push_back(tiled(std::span(table.masses).subspan(j * size, size), table.channels, settings.side, irradiance));
  }
  values.push_back(tiled(table.diffuse, table.channels, settings.side, Irradiance::with));
  if (table.channels == 1) values = packed(values);
  std::vector<std::vector<Image>> layers;
  layers.reserve(values.size());
  for (Image& value : values) layers.push_back({std::move(value)});
  return make_array_texture("iwasaki_amplitudes", std::move(layers), storage, {}, TextureFilter::linear);
}

// For each direction to the viewer: the share of a constant environment that the diffuse term reflects, in colour, and
// a normal with about its irradiance. The mean direction of a surface, a cosine over the hemisphere, has the length
// 2/3.
PrefilteredTexture diffuse_texture(const Amplitudes& table, int side) {
  const std::vector<glm::dvec3> directions = direction_grid(side);
  const std::size_t n = table.directions;
  std::vector<glm::vec4> shares, normals;
  for (std::size_t wo = 0; wo < n; ++wo) {
    glm::dvec3 sum(0.0), mean(0.0);
    double irradiance = 0.0;
    for (std::size_t wi = 0; wi < n; ++wi) {
      glm::dvec3 reflected(0.0);
      for (std::size_t c = 0; c < 3; ++c) {
        reflected[static_cast<int>(c)] = table.diffuse[((table.channels == 1 ? 0 : c) * n + wi) * n + wo];
      }
      sum += reflected;
      irradiance += directions[wi].z;
      mean += (reflected.x + reflected.y + reflected.z) * directions[wi];
    }
    const double total = sum.x + sum.y + sum.z;
    shares.emplace_back(glm::vec3(sum / irradiance), 0.0F);
    normals.emplace_back(total > 0.0 ? glm::vec3(1.5 / total * mean) : glm::vec3(0.0F, 0.0F, 1.0F), 0.0F);
  }
  const auto row = static_cast<std::size_t>(side);
  return make_array_texture("iwasaki_diffuse", {{texel_rows(row, shares)}, {texel_rows(row, normals)}}, Storage::fp32,
                            {}, TextureFilter::linear);
}

PrefilteredTexture brdf_texture(const Material& material) {
  const std::vector<BrdfLobe> lobes = lobes_of(lobe_of(material));
  Image image(static_cast<int>(lobes.size()), 1, 2);
  for (std::size_t i = 0; i < lobes.size(); ++i) {
    image.texels[2 * i] = static_cast<float>(lobes[i].sharpness);
    image.texels[2 * i + 1] = static_cast<float>(lobes[i].amplitude);
  }
  return make_texture("iwasaki_brdf", {image}, Storage::fp32, {});
}

// The diffuse term as a lobe of sharpness 0, followed by sharpness and colour of each lobe of a tabulated BRDF; and its
// rise.
std::array<PrefilteredTexture, 2> table_textures(const Material& material) {
  TabulatedLobes fitted{.diffuse = glm::vec3(0.0F), .lobes = {}, .rise = {glm::vec3(1.0F)}};
  if (is_tabulated(material)) fitted = lobes_of(*material.microgeometry->brdf);
  fitted.lobes.insert(fitted.lobes.begin(), {0.0, fitted.diffuse});
  std::vector<glm::vec4> lobes, rise;
  for (const ColorLobe& lobe : fitted.lobes) lobes.emplace_back(static_cast<float>(lobe.sharpness), lobe.amplitude);
  for (const glm::vec3& factor : fitted.rise) rise.emplace_back(factor, 0.0F);
  return {make_texture("iwasaki_table", {texel_rows(lobes.size(), lobes)}, Storage::fp32, {}),
          make_texture("iwasaki_rise", {texel_rows(rise.size(), rise)}, Storage::fp32, {})};
}

std::string note_of(const Material& material, const MaterialTable& table) {
  const std::size_t lobes = table.amplitudes.lobes.size();
  const std::string fitted =
      fmt::format("{} lobe{} for {} discretised normals; ", lobes, lobes == 1 ? "" : "s", table.normals);
  if (!material.microgeometry) {
    return "the normal map as a whole replaces the small-scale geometry, all of it seen: " + fitted +
           "its structure does not show at any distance";
  }
  return fmt::format("patch {}: {}{:.1f}% of its area is ever seen", material.microgeometry->patch.name, fitted,
                     100.0 * table.visible_share);
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
  BinnedFacets facets = bin_facets(patch, sample_facets(patch, settings.facets, settings.seed));
  return make_bvndf(patch, std::move(facets), direction_grid(settings.side), parts.next(9.0, ""));
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

namespace {

bool depends_on_brdf(const PrefilteredTexture& texture) {
  return texture.name == "iwasaki_brdf" || texture.name == "iwasaki_table" || texture.name == "iwasaki_rise";
}

void add_brdf_textures(const Material& material, const Options& options, const EffectSet& effects, Prefiltered& out) {
  if (options.word("lobe") == "sg") out.textures.push_back(brdf_texture(material));
  if (!has(effects, Effect::tabulated_brdf)) return;
  append(out.textures, table_textures(material));
  out.scalars["iwasaki_tabulated"] = is_tabulated(material) ? 1.0F : 0.0F;
}

}  // namespace

Prefiltered baked_material(const Material& material, const Options& options, const EffectSet& effects,
                           const Progress& progress) {
  const bool seen = has(effects, Effect::microgeometry_visibility);
  Prefiltered out;
  if (seen || has(effects, Effect::normal_variation)) {
    const TableSettings settings = table_settings(material, options, effects);
    const bool patch = seen && material.microgeometry != nullptr;
    const MaterialTable table = patch ? patch_table(material.microgeometry->patch, settings, progress)
                                      : flat_table(bin_normal_map(normal_map_of(material)), settings);
    out.textures.push_back(lobe_texture(table.amplitudes.lobes, table.shares));
    if (seen) {
      out.textures.push_back(amplitude_texture(table.amplitudes, settings, parse_storage(options.word("storage"))));
      if (has(effects, Effect::environment_light) &&
          (has(effects, Effect::diffuse) || has(effects, Effect::tabulated_brdf))) {
        out.textures.push_back(diffuse_texture(table.amplitudes, settings.side));
      }
    }
    out.notes = {note_of(material, table)};
  }
  add_brdf_textures(material, options, effects, out);
  return out;
}

Prefiltered with_other_brdf(const Prefiltered& before, const Material& material, const Options& options,
                            const EffectSet& effects) {
  Prefiltered out = before;
  std::erase_if(out.textures, depends_on_brdf);
  add_brdf_textures(material, options, effects, out);
  return out;
}

}  // namespace footprint::iwasaki_sg
