// `iwasaki_sg`: the visible normals of a patch of small-scale geometry as spherical Gaussians, convolved with the base
// BRDF. Iwasaki, Dobashi, Nishita 2012, "Interactive Bi-scale Editing of Highly Glossy Materials".
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "methods/iwasaki_sg/brdf_lobes.hpp"
#include "methods/iwasaki_sg/fit_error.hpp"
#include "methods/iwasaki_sg/material_table.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/stage_clock.hpp"
#include "renderer/microgeometry/direction_grid.hpp"
#include "renderer/microgeometry/microgeometry.hpp"
#include "renderer/pipeline/base_surface.hpp"
#include "renderer/pipeline/method.hpp"
#include "renderer/pipeline/patch_facets.hpp"
#include "renderer/pipeline/quantity.hpp"

namespace footprint {

namespace embedded {
extern const std::string_view iwasaki_sg_glsl, iwasaki_sg_lobes_glsl;
}

namespace {

using namespace iwasaki_sg;

OptionSpec whole_number(std::string name, double value, double minimum, double maximum, std::string meaning) {
  return {.name = std::move(name),
          .default_value = value,
          .minimum = minimum,
          .maximum = maximum,
          .choices = {},
          .meaning = std::move(meaning),
          .integer = true};
}

std::vector<OptionSpec> option_table() {
  return {whole_number("j", 7, 1, most_lobes,
                       "Most spherical Gaussians of the normal distribution; 3 and 7 fill texels of four with the "
                       "diffuse term."),
          whole_number("directions", 12, 2, 32, "Side of the grid of incident and outgoing directions."),
          whole_number("facets", 65536, 64, 1 << 24, "Samples of the patch."),
          word_option("lobe", {"base", "sg"},
                      "What a lobe of normals reflects with: the scene's base lobe, widened by that of the normals, or "
                      "the paper's spherical Gaussians, one or several fitted to the base lobe."),
          word_option("convolution", {"approximate", "exact"},
                      "lobe=sg: the convolution of two spherical Gaussians as one (Eq. 14), or exactly (Eq. 11)."),
          word_option("cosines", {"base", "published"},
                      "What facets weigh in the specular term: (n.wo), with the base BRDF's own cosine and geometry "
                      "term, or the paper's (n.wi)(n.wo) without a geometry term."),
          word_option("energy", {"conserved", "published"},
                      "Whether the amplitudes are scaled to hold what the visible facets hold; least squares alone, as "
                      "in the paper, does not."),
          word_option("storage", {"fp32", "fp16"}, "How the amplitudes are stored: 32-bit or 16-bit floats.")};
}

bool is_tabulated(const Material& material) { return material.microgeometry && material.microgeometry->brdf; }

TableSettings table_settings(const Material& material, const Options& options, const EffectSet& effects) {
  return {
      .lobes = static_cast<int>(options.number("j")),
      .side = static_cast<int>(options.number("directions")),
      .facets = static_cast<std::size_t>(options.number("facets")),
      .cosines = options.word("cosines") == "published" || is_tabulated(material) ? Cosines::published : Cosines::base,
      .energy = options.word("energy") == "conserved" ? Energy::conserved : Energy::published,
      .channels = has(effects, Effect::microgeometry_colour) ? std::size_t{3} : std::size_t{1},
      .paints = paint_factors(material)};
}

// Row 0: axis and sharpness of each lobe. Row 1: its share of the normals.
PrefilteredTexture lobe_texture(std::span<const Lobe> lobes, std::span<const double> shares) {
  Image image(static_cast<int>(lobes.size()), 2, 4);
  for (std::size_t j = 0; j < lobes.size(); ++j) {
    const glm::vec4 lobe(glm::vec3(lobes[j].axis), static_cast<float>(lobes[j].sharpness));
    std::copy_n(&lobe.x, 4, image.at(static_cast<int>(j), 0).begin());
    image.at(static_cast<int>(j), 1)[0] = static_cast<float>(shares[j]);
  }
  return make_texture("iwasaki_lobes", {image}, Storage::fp32, {});
}

// Whether a table has the facets' cosine to the light in it.
enum class Irradiance { without, with };

// [channel][wi][wo] as tiles: one for each cell of wo, in it a texel for each cell of wi. With a cosine to the light,
// values are divided by that of the surface as a whole: the ratio is smooth down to the horizon, and 1 for a plane.
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

// One channel of images, four to an image: a shader fetches them together. What is left over is 0.
std::vector<Image> packed(const std::vector<Image>& values) {
  std::vector<Image> out;
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (k % 4 == 0) out.emplace_back(values[k].width, values[k].height, 4);
    for (std::size_t i = 0; i < values[k].texels.size(); ++i) out.back().texels[4 * i + k % 4] = values[k].texels[i];
  }
  return out;
}

// The values of the lobes and, behind them, of the diffuse term: a layer each in colour, else four a layer.
PrefilteredTexture amplitude_texture(const Amplitudes& table, const TableSettings& settings, Storage storage) {
  const Irradiance irradiance = settings.cosines == Cosines::published ? Irradiance::with : Irradiance::without;
  const std::size_t size = table.channels * table.directions * table.directions;
  std::vector<Image> values;
  for (std::size_t j = 0; j < table.lobes.size(); ++j) {
    values.push_back(tiled(std::span(table.masses).subspan(j * size, size), table.channels, settings.side, irradiance));
  }
  values.push_back(tiled(table.diffuse, table.channels, settings.side, Irradiance::with));
  if (table.channels == 1) values = packed(values);
  std::vector<std::vector<Image>> layers;
  for (Image& value : values) layers.push_back({std::move(value)});
  return make_array_texture("iwasaki_amplitudes", layers, storage, {}, TextureFilter::linear);
}

PrefilteredTexture brdf_texture(const Material& material) {
  const std::vector<BrdfLobe> lobes = lobes_of(material.brdf.distribution, lobe_parameter(material));
  Image image(static_cast<int>(lobes.size()), 1, 2);
  for (std::size_t i = 0; i < lobes.size(); ++i) {
    image.texels[2 * i] = static_cast<float>(lobes[i].sharpness);
    image.texels[2 * i + 1] = static_cast<float>(lobes[i].amplitude);
  }
  return make_texture("iwasaki_brdf", {image}, Storage::fp32, {});
}

// Sharpness and colour of each lobe of the facets' own BRDF.
PrefilteredTexture table_texture(const Material& material) {
  std::vector<ColorLobe> lobes{{0.0, glm::vec3(0.0F)}};
  if (is_tabulated(material)) lobes = lobes_of(*material.microgeometry->brdf);
  Image image(static_cast<int>(lobes.size()), 1, 4);
  for (std::size_t i = 0; i < lobes.size(); ++i) {
    const glm::vec4 texel(static_cast<float>(lobes[i].sharpness), lobes[i].amplitude);
    std::copy_n(&texel.x, 4, image.at(static_cast<int>(i), 0).begin());
  }
  return make_texture("iwasaki_table", {image}, Storage::fp32, {});
}

double measured_convolution_error(const Material& /*material*/, const Options& /*options*/, const Options& parameters) {
  return convolution_error(parameters.number("eta1"), parameters.number("eta2"));
}

// What a fit is measured on: the material's patch by the method's options.
template <class Figure>
double of_patch(const Material& material, const Options& options, const Figure& figure) {
  if (!material.microgeometry) {
    throw Error(ErrorKind::usage, "material " + material.name, "has no patch of small-scale geometry",
                "take a scene with [microgeometry]");
  }
  return figure(material.microgeometry->patch, table_settings(material, options, {}));
}

double measured_fit_rms(const Material& material, const Options& options, const Options& /*parameters*/) {
  return of_patch(material, options, fit_rms);
}

double measured_relative_fit_rms(const Material& material, const Options& options, const Options& /*parameters*/) {
  return of_patch(material, options, relative_fit_rms);
}

double measured_jakob_error(const Material& /*material*/, const Options& /*options*/, const Options& parameters) {
  return jakob_convolution_error(parameters.number("eta1"), parameters.number("eta2"));
}

// Milliseconds of one stage of making the patch's table, once.
double stage_ms(const Material& material, const Options& options, std::string_view stage) {
  return of_patch(material, options, [&](const Patch& patch, const TableSettings& settings) {
    StageClock clock;
    (void)patch_table(patch, settings, clock.callback(no_progress));
    clock.stop();
    return 1e3 * std::ranges::find(clock.times(), stage, &StageTime::stage)->seconds;
  });
}

Quantity stage_quantity(std::string name, std::string of, decltype(Quantity::measure) measure) {
  return {std::move(name), "Time of " + of + " of the patch, once, milliseconds.", {}, measure};
}

std::vector<Quantity> quantity_table() {
  const auto sharpness = [](std::string name) {
    return OptionSpec{.name = std::move(name),
                      .default_value = 100.0,
                      .minimum = 1e-3,
                      .maximum = 1e6,
                      .choices = {},
                      .meaning = "Sharpness of one of the two spherical Gaussians.",
                      .integer = false};
  };
  return {
      {"convolution_error",
       "Largest difference of Eq. 14 from Eq. 11 over all angles, amplitudes of 1.",
       {sharpness("eta1"), sharpness("eta2")},
       measured_convolution_error},
      {"fit_rms",
       "Root mean square difference of the lobes from the BVNDF over all cells of normals and pairs of directions; "
       "1 is all that is seen.",
       {},
       measured_fit_rms},
      {"relative_fit_rms", "The same over the root mean square of the BVNDF.", {}, measured_relative_fit_rms},
      {"jakob_convolution_error",
       "The same of Jakob's (2012) one spherical Gaussian.",
       {sharpness("eta1"), sharpness("eta2")},
       measured_jakob_error},
      stage_quantity("visibility_ms", "the visibility",
                     [](const Material& m, const Options& o, const Options&) { return stage_ms(m, o, "visibility"); }),
      stage_quantity("bvndf_ms", "the BVNDF and its sums",
                     [](const Material& m, const Options& o, const Options&) { return stage_ms(m, o, "BVNDF"); }),
      stage_quantity("ndf_ms", "the fit of the NDF",
                     [](const Material& m, const Options& o, const Options&) { return stage_ms(m, o, "NDF"); }),
      stage_quantity("amplitudes_ms", "the amplitudes",
                     [](const Material& m, const Options& o, const Options&) { return stage_ms(m, o, "amplitudes"); })};
}

class IwasakiSg final : public Method, public HasQuantities {
 public:
  [[nodiscard]] const MethodInfo& info() const override { return info_; }

  [[nodiscard]] Prefiltered precompute(const Material& material, const Options& options, const EffectSet& effects,
                                       const Progress& progress) const override {
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
      }
      out.notes = notes(material, table);
    }
    if (options.word("lobe") == "sg") out.textures.push_back(brdf_texture(material));
    if (has(effects, Effect::tabulated_brdf)) {
      out.textures.push_back(table_texture(material));
      out.scalars["iwasaki_tabulated"] = is_tabulated(material) ? 1.0F : 0.0F;
    }
    return out;
  }

  [[nodiscard]] int lobe_count(const Options& options) const override { return static_cast<int>(options.number("j")); }

  [[nodiscard]] std::span<const Quantity> quantities() const override { return quantities_; }

  [[nodiscard]] std::string_view shader() const override { return shader_; }

 private:
  static std::vector<std::string> notes(const Material& material, const MaterialTable& table) {
    const std::size_t lobes = table.amplitudes.lobes.size();
    if (!material.microgeometry) {
      return {
          fmt::format("the normal map as a whole stands for the small-scale geometry, all of it seen: {} lobe{} "
                      "for {} discretised normals; its structure does not show at any distance",
                      lobes, lobes == 1 ? "" : "s", table.normals)};
    }
    return {fmt::format("patch {}: {} lobe{} for {} discretised normals; {:.1f}% of its area is ever seen",
                        material.microgeometry->patch.name, lobes, lobes == 1 ? "" : "s", table.normals,
                        100.0 * table.visible_share)};
  }

  MethodInfo info_{.name = "iwasaki_sg",
                   .summary =
                       "Visible normals of small-scale geometry as spherical Gaussians whose amplitudes depend on both "
                       "directions; one effective BRDF for the whole material.",
                   .paper =
                       "Iwasaki, Dobashi and Nishita 2012, Interactive Bi-scale Editing of Highly Glossy Materials, "
                       "ACM Transactions on Graphics 31(6)",
                   .options = option_table(),
                   .honours = all_effects_but({Effect::normal_layers, Effect::roughness_variation, Effect::multi_lobe}),
                   .resolves_texels = false};
  std::vector<Quantity> quantities_ = quantity_table();
  std::string shader_ = std::string(embedded::iwasaki_sg_glsl).append(embedded::iwasaki_sg_lobes_glsl);
};

}  // namespace

const Method& iwasaki_sg_method() {
  static const IwasakiSg method;
  return method;
}

}  // namespace footprint
