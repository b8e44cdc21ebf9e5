// `fournier`: a few Phong peaks per texel at every mip level, fitted to the distribution of normals. All peaks of the
// footprint's texels are summed. Fournier 1992, "Normal distribution functions and multiple surfaces".
#include <utility>
#include <vector>

#include "methods/fournier/peak_chain.hpp"
#include "renderer/bake/facets.hpp"
#include "renderer/bake/material_maps.hpp"
#include "renderer/bake/method.hpp"
#include "renderer/bake/normal_chain.hpp"

namespace footprint {

extern const EmbeddedTexts fournier_glsl;

namespace {

struct Settings {
  const Options& options;
  std::size_t peaks = static_cast<std::size_t>(options.number("peaks"));
  fournier::FitRule rule{.start = options.word("starts") == "own" ? fournier::Start::own : fournier::Start::inherited,
                         .evaluations = static_cast<int>(options.number("evaluations"))};
  Storage storage = parse_storage(options.word("storage"));
};

// The slope variance of the lobe that peaks are fitted with: the mean if roughness varies or facets have several lobes.
double base_variance(const Material& material) {
  if (width_map(material) == nullptr) return mean_lobe_variance(material);
  return lobe_variance_chain(material).back().texels.front();
}

Prefiltered precompute(const Material& material, const Options& options, const EffectSet& effects,
                       const Progress& progress) {
  const Settings settings{options};
  Prefiltered out;
  if (has(effects, Effect::normal_variation)) {
    fournier::add_peaks("fournier",
                        fournier::fit_peak_chain(normal_map_of(material), base_variance(material), settings.peaks,
                                                 settings.rule, progress),
                        material, settings.storage, effects, out);
  }
  append(out.textures, bake_lobe_variance(material, settings.storage, effects, roughness_mean(options)).textures);
  return out;
}

}  // namespace

const Method& fournier_method() {
  static const Method method{
      .info =
          {.name = "fournier",
           .summary = "Phong peaks fitted to every texel's distribution of normals; those of eight texels are summed.",
           .paper = "Fournier 1992, Normal Distribution Functions and Multiple Surfaces (as Tan 2005 compares with it)",
           .options = {whole_option(
                           "peaks", 7, 1, 8,
                           "Peaks per texel above the finest level: 7 as Fournier has them, 4 in Tan 2005, figure 7. A "
                           "pixel sums up to 8 times as many."),
                       word_option(
                           "starts", {"inherited", "own"},
                           "Where the fit of a texel starts from: the peaks of the finer texels below it, or the "
                           "heaviest of its own normals, each with those nearest to it."),
                       whole_option("evaluations", fournier::most_evaluations, 1, fournier::most_evaluations,
                                    "Evaluations of its error after which the fit of a texel stops."),
                       float_storage_option(), roughness_mean_option()},
           .honours = map_effects_but({Effect::anisotropic_lobe, Effect::normal_layers}),
           .slow_precompute = true,
           .bakes_by_texel = true},
      .precompute = precompute,
      .shader = module_of(fournier_glsl, "fournier.glsl"),
      .lobe_count = [](const Options& options) { return 8 * static_cast<int>(Settings{options}.peaks); }};
  return method;
}

}  // namespace footprint
