// The finest level of every map as it is, and the facets of small-scale geometry.
#include "renderer/pipeline/base_surface.hpp"

#include <algorithm>
#include <array>
#include <iterator>

#include "renderer/bake/facets.hpp"
#include "renderer/bake/material_maps.hpp"
#include "renderer/microgeometry/microgeometry.hpp"

namespace footprint {

extern const EmbeddedTexts shared_glsl;

namespace {

const std::array<SharedMap, 3> finest_maps{
    {{Effect::normal_variation, "base_normal", normal_map_of, normal_coordinates},
     {Effect::normal_layers, "base_layer", layer_map_of, layer_coordinates},
     {Effect::roughness_variation, "base_roughness", roughness_map_of, roughness_coordinates}}};

Prefiltered precompute(const Material& material, const Options& /*options*/, const EffectSet& effects,
                       const Progress& progress) {
  Prefiltered out;
  for (const SharedMap& map : finest_maps) {
    if (has(effects, map.effect))
      out.textures.push_back(
          make_level_texture(std::string(map.name), map.image(material), Storage::fp32, map.coordinates(material)));
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
