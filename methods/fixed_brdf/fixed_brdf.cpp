// `fixed_brdf`: filters geometry but not reflectance. The renormalised mean normal shades with the lobe of a single
// facet at every distance. Tan 2005 compares with it (figure 8).
#include "renderer/bake/material_maps.hpp"
#include "renderer/bake/method.hpp"
#include "renderer/bake/normal_chain.hpp"

namespace footprint {

extern const EmbeddedTexts fixed_brdf_glsl;

namespace {

Prefiltered precompute(const Material& material, const Options& options, const EffectSet& effects,
                       const Progress& /*progress*/) {
  const Storage storage = parse_storage(options.word("storage"));
  Prefiltered out = bake_mean_normal(material, storage, effects);
  if (has(effects, Effect::roughness_variation)) {
    // Only the finest level, because reflectance is not filtered.
    out.textures.push_back(
        make_level_texture("fixed_roughness", roughness_map_of(material), storage, roughness_coordinates(material)));
  }
  return out;
}

}  // namespace

const Method& fixed_brdf_method() {
  static const Method method{
      .info =
          {.name = "fixed_brdf",
           .summary = "The finest level's reflectance at any distance, over geometry that is filtered.",
           .paper =
               "Tan, Lin, Quan, Guo, Shum 2005, Multiresolution Reflectance Filtering, EGSR (its comparison, figure 8)",
           .options = {storage_option()},
           .honours = map_effects_but({Effect::anisotropic_lobe, Effect::normal_layers})},
      .precompute = precompute,
      .shader = module_of(fixed_brdf_glsl, "fixed_brdf.glsl")};
  return method;
}

}  // namespace footprint
