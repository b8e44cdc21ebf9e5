// `lean`: first and second moments of slope filter linearly and give a footprint's mean slope and covariance; one
// anisotropic lobe stands over them. Olano and Baker 2010, "LEAN Mapping"; CLEAN is its scalar variant.
#include <algorithm>

#include "renderer/bake/material_maps.hpp"
#include "renderer/bake/method.hpp"
#include "renderer/bake/normal_chain.hpp"
#include "renderer/bake/slope_moments.hpp"

namespace footprint {

namespace embedded {
extern const EmbeddedTexts lean_glsl;
}

namespace {

SlopeVariant variant_of(const Options& options) {
  return options.word("variant") == "clean" ? SlopeVariant::scalar : SlopeVariant::full;
}

// What the diffuse term goes by; of layers it has the slopes alone.
bool keeps_mean_normal(const EffectSet& effects) {
  return has(effects, Effect::diffuse) && !has(effects, Effect::normal_layers);
}

class Lean final : public Method {
 public:
  [[nodiscard]] const MethodInfo& info() const override { return info_; }

  [[nodiscard]] Prefiltered precompute(const Material& material, const Options& options, const EffectSet& effects,
                                       const Progress& /*progress*/) const override {
    Prefiltered out = bake_slopes(material, options, effects, variant_of(options));
    if (has(effects, Effect::normal_variation) && keeps_mean_normal(effects)) {
      out.textures.push_back(make_texture("lean_normal", mean_normal_chain(material),
                                          parse_storage(options.word("storage")), normal_coordinates(material)));
    }
    return out;
  }

  [[nodiscard]] std::optional<BakeMemory> normal_memory(const Material& material, const Options& options,
                                                        const EffectSet& effects) const override {
    const BakeMemory slopes = slope_memory(material, options, variant_of(options));
    if (!keeps_mean_normal(effects)) return slopes;
    const BakeMemory normals = mean_normal_memory(material, channel_bytes(parse_storage(options.word("storage"))));
    return BakeMemory{.kept = slopes.kept + normals.kept,
                      .baking = std::max(slopes.baking, slopes.kept + normals.baking)};
  }

  [[nodiscard]] ShaderModule shader() const override { return module_of(embedded::lean_glsl, "lean.glsl"); }

 private:
  MethodInfo info_{.name = "lean",
                   .summary = "One anisotropic lobe over the mean and the covariance of the footprint's slopes.",
                   .paper = "Olano and Baker 2010, LEAN Mapping, I3D",
                   .options = {slope_storage_option(), slope_roughness_option(), steepest_slope_option(),
                               word_option("variant", {"lean", "clean"},
                                           "The whole covariance of slopes, or its trace alone (CLEAN): a round lobe "
                                           "and three channels instead of five.")},
                   .honours = map_effects_but({Effect::multi_lobe})};
};

}  // namespace

const Method& lean_method() {
  static const Lean method;
  return method;
}

}  // namespace footprint
