// `best_lobes`: what K lobes per texel can represent at best. They are fitted to the distribution of normals under the
// texel, convolved with the base lobe, and those of all texels of a footprint are summed. A bound for methods of as
// many lobes, which takes minutes to bake.
#include <fmt/format.h>

#include <atomic>
#include <utility>
#include <vector>

#include "methods/best_lobes/other_methods.hpp"
#include "methods/best_lobes/texel_fit.hpp"
#include "methods/fournier/peak_chain.hpp"
#include "renderer/bake/material_maps.hpp"
#include "renderer/bake/method.hpp"
#include "renderer/bake/normal_chain.hpp"

namespace footprint {

extern const EmbeddedTexts best_lobes_glsl;

namespace {

using best_lobes::FittedLobe;
using best_lobes::LobeFamily;
using best_lobes::OtherMethods;
using best_lobes::Shape;
using fournier::Layer;

// The options that the bake reads.
struct Settings {
  std::size_t lobes;
  Shape shape;
};

Settings settings_of(const Options& options) {
  return {.lobes = static_cast<std::size_t>(options.number("k")),
          .shape = options.word("shape") == "round" ? Shape::round : Shape::stretched};
}

// The lobes of one texel as layers: axis, deviation and weight of each; then the spreads.
std::vector<Layer> layers_of(const std::vector<FittedLobe>& lobes, std::size_t count) {
  std::vector<Layer> out;
  for (const FittedLobe& lobe : lobes)
    out.push_back(fournier::layer_of({.weight = lobe.weight,
                                      .axis = best_lobes::direction_from_plane(lobe.mean),
                                      .spread = lobe.deviation * lobe.deviation}));
  out.resize(count, Layer{});
  for (const FittedLobe& lobe : lobes) {
    const Eigen::Vector3f spread = lobe.spread().cast<float>();
    out.push_back({spread.x(), spread.y(), spread.z(), 0.0F});
  }
  return out;
}

// Those of 1 to `count` lobes.
std::vector<OtherMethods> other_methods(const Material& material, std::size_t count, const Progress& progress) {
  std::vector<OtherMethods> others;
  for (std::size_t k = 1; k <= count; ++k) {
    const double done = static_cast<double>(k - 1) / static_cast<double>(count);
    others.emplace_back(material, k, [&](std::string_view what, double /*fraction*/) { progress(what, 0.1 * done); });
  }
  return others;
}

void add_lobes(const Material& material, const Settings& settings, const Progress& progress, Prefiltered& out) {
  const LobeFamily family(material.brdf.distribution, lobe_variance_chain(material).back().texels.front(),
                          settings.shape);
  const std::vector<OtherMethods> others = other_methods(material, settings.lobes, progress);
  std::atomic<std::size_t> not_resolved = 0;
  const auto fit = [&](const fournier::TexelPlace& place, const std::vector<fournier::Peak>& target,
                       const std::vector<fournier::Moments>&) {
    const auto starts = [&](std::size_t k) { return others[k - 1].at(place.level, place.texel, settings.shape); };
    const best_lobes::LobeFit found = best_lobes::fit_lobes(target, settings.lobes, family, starts);
    if (!found.resolved) ++not_resolved;
    return fournier::TexelFit{.layers = layers_of(found.lobes, settings.lobes),
                              .fitted = true,
                              .converged = found.converged,
                              .error = found.error};
  };
  fournier::PeakChain chain =
      fournier::fit_chain(normal_map_of(material),
                          {.cells = fournier::NormalCells(best_lobes::cell_edge(family)),
                           .peaks = settings.lobes,
                           .layers = 2 * settings.lobes},
                          fit, [&](std::string_view what, double fraction) { progress(what, 0.1 + 0.9 * fraction); });
  if (chain.statistics.not_converged > 0) out.notes.push_back(fournier::note_on(chain.statistics));
  if (not_resolved > 0)
    out.notes.push_back(
        fmt::format("{} of {} texels have too many directions for so narrow a base lobe: they are "
                    "fitted under a wider one and are no bound",
                    not_resolved.load(), chain.statistics.fits));
  const TextureCoordinates coordinates = normal_coordinates(material);
  std::vector<std::vector<Image>> first;  // an initializer list would copy the chain
  first.push_back(std::move(chain.first));
  out.textures.push_back(
      make_array_texture("best_lobes_first", std::move(first), Storage::fp32, coordinates, TextureFilter::nearest));
  out.textures.push_back(
      make_array_texture("best_lobes_rest", std::move(chain.rest), Storage::fp32, coordinates, TextureFilter::nearest));
}

Prefiltered precompute(const Material& material, const Options& options, const EffectSet& effects,
                       const Progress& progress) {
  Prefiltered out;
  if (has(effects, Effect::normal_variation)) {
    add_lobes(material, settings_of(options), progress, out);
    if (has(effects, Effect::diffuse)) {
      out.textures.push_back(
          make_texture("best_lobes_mean", mean_normal_chain(material), Storage::fp32, normal_coordinates(material)));
    }
  }
  append(out.textures, bake_lobe_variance(material, Storage::fp32, effects).textures);
  return out;
}

}  // namespace

const Method& best_lobes_method() {
  static const Method method{
      .info = {.name = "best_lobes",
               .summary = "The best k lobes of every texel, summed over the footprint: a bound for methods of as many "
                          "lobes.",
               .paper = "",
               .options = {whole_option("k", 4, 1, 8,
                                        "Lobes per texel above the finest level. A pixel sums up to 8 times as many."),
                           word_option("shape", {"stretched", "round"},
                                       "The base lobe widened, then stretched to a covariance: the lobes of cells and "
                                       "tan_gmm. Or widened alone, as tan_gmm has it.")},
               .honours = map_effects_but({Effect::multi_lobe, Effect::normal_layers}),
               .slow_precompute = true,
               .slow_frame = true},
      .precompute = precompute,
      .shader = module_of(best_lobes_glsl, "best_lobes.glsl", {{"density_fast", false}}),
      .lobe_count = [](const Options& options) { return 8 * static_cast<int>(settings_of(options).lobes); }};
  return method;
}

}  // namespace footprint
