// The finest level of every map as it is, and the facets of small-scale geometry.
#include "renderer/pipeline/base_surface.hpp"

#include <algorithm>
#include <iterator>

#include "renderer/bake/facets.hpp"
#include "renderer/bake/material_maps.hpp"
#include "renderer/microgeometry/microgeometry.hpp"

namespace footprint {

extern const EmbeddedTexts shared_glsl;

namespace {

Prefiltered precompute(const Material& material, const Options& /*options*/, const EffectSet& effects,
                       const Progress& progress) {
  Prefiltered out;
  if (has(effects, Effect::normal_variation)) {
    out.textures.push_back(
        make_level_texture("base_normal", normal_map_of(material), Storage::fp32, normal_coordinates(material)));
  }
  if (has(effects, Effect::normal_layers)) {
    out.textures.push_back(
        make_level_texture("base_layer", layer_map_of(material), Storage::fp32, layer_coordinates(material)));
  }
  if (has(effects, Effect::roughness_variation)) {
    out.textures.push_back(make_level_texture("base_roughness", roughness_map_of(material), Storage::fp32,
                                              roughness_coordinates(material)));
  }
  if (has(effects, Effect::microgeometry_visibility)) {
    std::ranges::move(patch_facet_textures(material, progress), std::back_inserter(out.textures));
    out.scalars["base_has_patch"] = material.microgeometry ? 1.0F : 0.0F;
  }
  if (has(effects, Effect::microgeometry_colour)) out.textures.push_back(paint_texture(material));
  if (has(effects, Effect::tabulated_brdf)) {
    out.textures.push_back(tabulated_brdf_texture(material));
    out.scalars["base_has_table"] = material.microgeometry && material.microgeometry->brdf ? 1.0F : 0.0F;
  }
  return out;
}

}  // namespace

const Method& base_surface() {
  static const Method method{
      .info = {.name = "reference",
               .summary =
                   "The supersampled reference: many samples per pixel, each shading the base BRDF of one texel.",
               .paper = "",
               .options = {},
               .honours = EffectSet{}.set(),
               .draws_directions = true},
      .precompute = precompute,
      .shader = module_of(shared_glsl, "base_surface.glsl")};
  return method;
}

}  // namespace footprint
