// `lean`: first and second moments of slope filter linearly and give the mean and the covariance of a footprint's
// slopes, which define one anisotropic lobe. Olano and Baker 2010, "LEAN Mapping"; CLEAN is its scalar variant.
#include "renderer/bake/method.hpp"
#include "renderer/bake/normal_chain.hpp"
#include "renderer/bake/slope_moments.hpp"

namespace footprint {

extern const EmbeddedTexts lean_glsl;

namespace {

// The diffuse term reads the mean normal; of detail layers only the slopes are stored.
StoredSlopes stored_slopes(const Options& options, const EffectSet& effects) {
  return {.variant = options.word("variant") == "clean" ? SlopeVariant::scalar : SlopeVariant::full,
          .mean_normal = has(effects, Effect::diffuse) && !has(effects, Effect::normal_layers)};
}

Prefiltered precompute(const Material& material, const Options& options, const EffectSet& effects,
                       const Progress& /*progress*/) {
  return bake_slopes(material, options, effects, stored_slopes(options, effects));
}

}  // namespace

const Method& lean_method() {
  static const Method method{
      .info = {.name = "lean",
               .summary = "One anisotropic lobe over the mean and the covariance of the footprint's slopes.",
               .paper = "Olano and Baker 2010, LEAN Mapping, I3D",
               .options = {float_storage_option(), slope_roughness_option(), steepest_slope_option(),
                           word_option("variant", {"lean", "clean"},
                                       "The whole covariance of slopes, or its trace alone (CLEAN): a round lobe "
                                       "and three channels instead of five.")},
               .honours = map_effects_but({Effect::multi_lobe})},
      .precompute = precompute,
      // footprint_slopes.glsl serves `lean` and `leadr`, which differ in this texture.
      .shader = module_of(lean_glsl, "lean.glsl", {{"with_mean_normal", true}})};
  return method;
}

}  // namespace footprint
