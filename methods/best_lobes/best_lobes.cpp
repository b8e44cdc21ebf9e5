// `best_lobes`: what K lobes per texel can represent at best. They are fitted to the distribution of normals under the
// texel, convolved with the base lobe, and those of all texels of a footprint are summed. A bound for methods of as
// many lobes, which takes minutes to bake.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "methods/best_lobes/lobe_shapes.hpp"
#include "methods/best_lobes/starts.hpp"
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

struct Settings {
  std::size_t lobes;
  Shape shape;
};

Settings settings_of(const Options& options) {
  return {.lobes = static_cast<std::size_t>(options.number("k")),
          .shape = options.word("shape") == "round" ? Shape::round : Shape::stretched};
}

// The lobes of one texel as layers: axis, deviation and weight of each; then the spreads, and the factor of the
// weights.
std::vector<Layer> layers_of(const std::vector<FittedLobe>& lobes, std::size_t count, double factor) {
  std::vector<Layer> out;
  out.reserve(lobes.size());
  for (const FittedLobe& lobe : lobes)
    out.push_back(fournier::layer_of({.weight = lobe.weight,
                                      .axis = best_lobes::direction_from_plane(lobe.mean),
                                      .spread = lobe.deviation * lobe.deviation}));
  out.resize(count, Layer{});
  for (const FittedLobe& lobe : lobes) {
    const Eigen::Vector3f spread = lobe.spread().cast<float>();
    out.push_back({spread.x(), spread.y(), spread.z(), static_cast<float>(factor)});
  }
  return out;
}

double sum_of_weights(const auto& lobes) {
  double sum = 0.0;
  for (const auto& lobe : lobes) sum += lobe.weight;
  return sum;
}

// The other methods with 1 to `count` lobes.
std::vector<OtherMethods> other_methods(const Material& material, std::size_t count, bool with_roughness,
                                        const Progress& progress) {
  std::vector<OtherMethods> others;
  for (std::size_t k = 1; k <= count; ++k) {
    const double done = static_cast<double>(k - 1) / static_cast<double>(count);
    others.emplace_back(material, k, with_roughness,
                        [&](std::string_view what, double /*fraction*/) { progress(what, 0.1 * done); });
  }
  return others;
}

class Fitter {
 public:
  // groups: null if all texels have one roughness, or are taken to have.
  Fitter(const Material& material, const Settings& settings, const best_lobes::RoughnessGroups* groups,
         const Progress& progress)
      : settings_(settings),
        groups_(groups),
        family_(material.brdf.distribution,
                groups != nullptr ? groups->narrowest : lobe_variance_chain(material).back().texels.front(),
                settings.shape),
        others_(other_methods(material, settings.lobes, groups != nullptr, progress)) {}

  [[nodiscard]] double cell_edge() const { return best_lobes::cell_edge(family_); }

  [[nodiscard]] fournier::TexelFit fit(const fournier::TexelPlace& place,
                                       const std::vector<fournier::Peak>& target) const {
    return groups_ == nullptr ? fit_of_one_roughness(place, target) : fit_with_roughness(place, target);
  }

  [[nodiscard]] std::size_t not_resolved() const { return not_resolved_; }

 private:
  [[nodiscard]] fournier::TexelFit texel_fit(const best_lobes::LobeFit& found, double factor) const {
    if (!found.resolved) ++not_resolved_;
    return {.layers = layers_of(found.lobes, settings_.lobes, factor),
            .fitted = true,
            .converged = found.converged,
            .error = found.error};
  }

  [[nodiscard]] fournier::TexelFit fit_of_one_roughness(const fournier::TexelPlace& place,
                                                        const std::vector<fournier::Peak>& target) const {
    const auto starts = [&](std::size_t k) { return others_[k - 1].at(place.level, place.texel, family_); };
    return texel_fit(best_lobes::fit_lobes(target, settings_.lobes, family_, starts), 1.0);
  }

  // The base lobe of the fit is the narrowest under the texel. A lobe of the fit has the energy of that base lobe, a
  // facet and a stored lobe that of its own width: so weights change by the energies' ratio, and their sum is free.
  [[nodiscard]] fournier::TexelFit fit_with_roughness(const fournier::TexelPlace& place,
                                                      std::vector<fournier::Peak> target) const {
    const double narrowest =
        std::max(std::ranges::min(target, {}, &fournier::Peak::spread).spread - cell_edge() * cell_edge(), 0.0);
    const LobeFamily family(family_.distribution(), family_.variance() + narrowest, family_.shape());
    const double covered = sum_of_weights(target);
    for (fournier::Peak& peak : target) {
      peak.spread -= std::min(narrowest, peak.spread);
      peak.weight *= family.energy(peak.spread);
    }
    const double energy = sum_of_weights(target) / covered;
    const auto starts = [&](std::size_t k) {
      auto mixtures = others_[k - 1].at(place.level, place.texel, family);
      for (std::vector<FittedLobe>& mixture : mixtures)
        for (FittedLobe& lobe : mixture) lobe.weight /= energy;
      return mixtures;
    };
    best_lobes::LobeFit found =
        best_lobes::fit_lobes(target, settings_.lobes, family, starts, best_lobes::Weights::free);
    for (FittedLobe& lobe : found.lobes) {
      const double spread = lobe.deviation * lobe.deviation;
      lobe.weight /= family.energy(spread);
      lobe.deviation = std::sqrt(spread + narrowest);
    }
    const double factor = sum_of_weights(found.lobes) / covered;
    for (FittedLobe& lobe : found.lobes) lobe.weight /= factor;
    std::ranges::stable_sort(found.lobes, std::greater{}, &FittedLobe::weight);
    return texel_fit(found, factor);
  }

  Settings settings_;
  const best_lobes::RoughnessGroups* groups_;
  LobeFamily family_;
  std::vector<OtherMethods> others_;
  mutable std::atomic<std::size_t> not_resolved_ = 0;
};

void add_lobes(const Material& material, const Settings& settings, const EffectSet& effects, const Progress& progress,
               Prefiltered& out) {
  const bool roughness_varies = has(effects, Effect::roughness_variation);
  const Image normals = normal_map_of(material);
  const bool joint = roughness_varies && roughness_lies_on_normals(material);
  best_lobes::RoughnessGroups groups;
  if (joint) groups = best_lobes::roughness_groups(material, normals.width, normals.height);
  if (roughness_varies) {
    out.scalars["best_lobes_joint"] = joint ? 1.0F : 0.0F;
    out.scalars["best_lobes_narrowest"] = static_cast<float>(groups.narrowest);
  }
  const Fitter fitter(material, settings, joint ? &groups : nullptr, progress);
  fournier::PeakChain chain = fournier::fit_chain(
      normals,
      {.cells = fournier::NormalCells(fitter.cell_edge()),
       .peaks = settings.lobes,
       .layers = 2 * settings.lobes,
       .groups = groups.of_texels,
       .group_spreads = groups.spreads},
      [&](const auto& place, const auto& target, const auto& /*children*/) { return fitter.fit(place, target); },
      [&](std::string_view what, double fraction) { progress(what, 0.1 + 0.9 * fraction); });
  const std::size_t fits = chain.statistics.fits;
  fournier::add_peaks("best_lobes", std::move(chain), material, Storage::fp32, effects, out);
  if (fitter.not_resolved() > 0)
    out.notes.push_back(
        fmt::format("{} of {} texels have too many directions for so narrow a base lobe: they are "
                    "fitted under a wider one and are no bound",
                    fitter.not_resolved(), fits));
  if (roughness_varies && !joint)
    out.notes.emplace_back(
        "the roughness map does not lie on the normal map's texels: lobes are fitted for the mean of "
        "all roughness and are no bound");
}

Prefiltered precompute(const Material& material, const Options& options, const EffectSet& effects,
                       const Progress& progress) {
  Prefiltered out;
  if (has(effects, Effect::normal_variation)) add_lobes(material, settings_of(options), effects, progress, out);
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
               .honours = map_effects_but({Effect::anisotropic_lobe, Effect::multi_lobe, Effect::normal_layers}),
               .slow_precompute = true,
               .slow_frame = true},
      .precompute = precompute,
      .shader = module_of(best_lobes_glsl, "best_lobes.glsl"),
      .lobe_count = [](const Options& options) { return 8 * static_cast<int>(settings_of(options).lobes); }};
  return method;
}

}  // namespace footprint
