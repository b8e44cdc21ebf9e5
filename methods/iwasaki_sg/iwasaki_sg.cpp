// `iwasaki_sg`: represents the visible normals of a patch of small-scale geometry by spherical Gaussians, and convolves
// them with the base BRDF. Iwasaki, Dobashi, Nishita 2012, "Interactive Bi-scale Editing of Highly Glossy Materials".
#include <string>

#include "methods/iwasaki_sg/material_table.hpp"
#include "methods/iwasaki_sg/table_textures.hpp"
#include "renderer/bake/method.hpp"

namespace footprint {

namespace embedded {
extern const EmbeddedTexts iwasaki_sg_glsl;
}

namespace {

using namespace iwasaki_sg;

class IwasakiSg final : public Method {
 public:
  [[nodiscard]] const MethodInfo& info() const override { return info_; }

  [[nodiscard]] Prefiltered precompute(const Material& material, const Options& options, const EffectSet& effects,
                                       const Progress& progress) const override {
    return baked_material(material, options, effects, progress);
  }

  [[nodiscard]] int lobe_count(const Options& options) const override { return static_cast<int>(options.number("j")); }

  [[nodiscard]] ShaderModule shader() const override { return module_of(embedded::iwasaki_sg_glsl, "iwasaki_sg.glsl"); }

 private:
  MethodInfo info_{.name = "iwasaki_sg",
                   .summary =
                       "Visible normals of small-scale geometry as spherical Gaussians whose amplitudes depend on both "
                       "directions; one effective BRDF for the whole material.",
                   .paper =
                       "Iwasaki, Dobashi and Nishita 2012, Interactive Bi-scale Editing of Highly Glossy Materials, "
                       "ACM Transactions on Graphics 31(6)",
                   .options = option_table(),
                   .honours = all_effects_but({Effect::normal_layers, Effect::roughness_variation, Effect::multi_lobe}),
                   .lobes_as_given = true,
                   .resolves_texels = false};
};

}  // namespace

const Method& iwasaki_sg_method() {
  static const IwasakiSg method;
  return method;
}

}  // namespace footprint
