// `iwasaki_sg`: represents the visible normals of a patch of small-scale geometry by spherical Gaussians, and convolves
// them with the base BRDF. Iwasaki, Dobashi, Nishita 2012, "Interactive Bi-scale Editing of Highly Glossy Materials".

#include "methods/iwasaki_sg/lobe_fit.hpp"
#include "methods/iwasaki_sg/material_table.hpp"
#include "renderer/bake/method.hpp"

namespace footprint {

extern const EmbeddedTexts iwasaki_sg_glsl;

namespace {

using namespace iwasaki_sg;

// The Gaussians come first, so that a bake after an edit of the BRDF has the textures in the same order.
Prefiltered baked_in_scene(const Scene& scene, std::size_t material, const Options& options, const EffectSet& effects,
                           const Progress& progress) {
  Prefiltered out = baked_material(scene.materials.at(material), options, effects, progress);
  if (options.word("environment") == "gaussians" && has(effects, Effect::environment_light) &&
      has(effects, Effect::diffuse) && !has(effects, Effect::tabulated_brdf))
    out.textures.insert(out.textures.begin(),
                        environment_texture(scene.environment.value_or(constant_environment(glm::vec3(0.0F)))));
  return out;
}

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
               .honours = all_effects_but(
                   {Effect::anisotropic_lobe, Effect::normal_layers, Effect::roughness_variation, Effect::multi_lobe}),
               .lobes_as_given = true,
               .sums_environment = true,
               .resolves_texels = false},
      .precompute = baked_material,
      .shader = module_of(iwasaki_sg_glsl, "iwasaki_sg.glsl"),
      .precompute_on = baked_in_scene,
      .precompute_brdf = with_other_brdf,
      .lobe_count = [](const Options& options) { return static_cast<int>(options.number("j")); }};
  return method;
}

}  // namespace footprint
