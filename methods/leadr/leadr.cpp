// `leadr`: the moments of slope as one off-centre anisotropic lobe, with masking and shadowing by the same slopes.
// Dupuy et al. 2013, "Linear Efficient Antialiased Displacement and Reflectance Mapping".
#include "renderer/bake/slope_moments.hpp"

#include "renderer/bake/method.hpp"

namespace footprint {

namespace embedded {
extern const EmbeddedTexts leadr_glsl;
}

namespace {

class Leadr final : public Method {
 public:
  [[nodiscard]] const MethodInfo& info() const override { return info_; }

  [[nodiscard]] Prefiltered precompute(const Material& material, const Options& options, const EffectSet& effects,
                                       const Progress& /*progress*/) const override {
    return bake_slopes(material, options, effects, SlopeVariant::full);
  }

  // `variant` is an option of lean's, which common_slopes.glsl asks for.
  [[nodiscard]] ShaderModule shader() const override {
    return module_of(embedded::leadr_glsl, "leadr.glsl", {{"variant_clean", false}});
  }

 private:
  MethodInfo info_{.name = "leadr",
                   .summary = "The lobe of the footprint's slopes, masked and shadowed by those slopes.",
                   .paper =
                       "Dupuy et al. 2013, Linear Efficient Antialiased Displacement and Reflectance Mapping, "
                       "ACM TOG 32(6)",
                   .options = {slope_storage_option(), slope_roughness_option(), steepest_slope_option(),
                               word_option("weighting", {"bump", "displacement"},
                                           "What a texel counts for: all the same, as in a normal map, or its true and "
                                           "visible area, as on a displaced surface.")},
                   .honours = map_effects_but({Effect::multi_lobe})};
};

}  // namespace

const Method& leadr_method() {
  static const Leadr method;
  return method;
}

}  // namespace footprint
