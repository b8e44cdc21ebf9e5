// `iwasaki_sg`: represents the visible normals of a patch of small-scale geometry by spherical Gaussians, and convolves
// them with the base BRDF. Iwasaki, Dobashi, Nishita 2012, "Interactive Bi-scale Editing of Highly Glossy Materials".
#include <string>

#include "methods/iwasaki_sg/material_table.hpp"
#include "methods/iwasaki_sg/table_textures.hpp"
#include "renderer/bake/method.hpp"

namespace footprint {

extern const EmbeddedTexts iwasaki_sg_glsl;

namespace {

using namespace iwasaki_sg;

}  // namespace

const Method& iwasaki_sg_method() {
  static const Method method{
      .info = {.name = "iwasaki_sg",
               .summary =
                   "Visible normals of small-scale geometry as spherical Gaussians whose amplitudes depend on both "
                   "directions; one effective BRDF for the whole material.",
               .paper = "Iwasaki, Dobashi and Nishita 2012, Interactive Bi-scale Editing of Highly Glossy Materials, "
                        "ACM Transactions on Graphics 31(6)",
               .options = option_table(),
               .honours = all_effects_but({Effect::normal_layers, Effect::roughness_variation, Effect::multi_lobe}),
               .lobes_as_given = true,
               .resolves_texels = false},
      .precompute = baked_material,
      .shader = module_of(iwasaki_sg_glsl, "iwasaki_sg.glsl"),
      .lobe_count = [](const Options& options) { return static_cast<int>(options.number("j")); }};
  return method;
}

}  // namespace footprint
