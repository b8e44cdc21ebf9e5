// `exact`: sums the base BRDF over the texels of the finest level under a kernel, for every pixel and light, without an
// NDF. It bounds the accuracy of every method that stores NDFs under the same kernel, and is far too slow to use.
#include "renderer/bake/material_maps.hpp"
#include "renderer/pipeline/base_surface.hpp"

namespace footprint {

extern const EmbeddedTexts exact_glsl;

namespace {

// The coordinates of the map whose texels are summed.
TextureCoordinates grid_coordinates(const Material& material, const EffectSet& effects) {
  if (has(effects, Effect::normal_variation)) return normal_coordinates(material);
  if (has(effects, Effect::normal_layers)) return layer_coordinates(material);
  return roughness_coordinates(material);
}

Prefiltered precompute(const Material& material, const Options& options, const EffectSet& effects,
                       const Progress& progress) {
  Prefiltered out = base_surface().precompute(material, options, effects, progress);
  for (PrefilteredTexture& texture : out.textures) texture.filter = TextureFilter::nearest;
  const std::array<Wrap, 2> wrap = grid_coordinates(material, effects).wrap;
  out.scalars["exact_clamp_u"] = wrap[0] == Wrap::clamp_to_edge ? 1.0F : 0.0F;
  out.scalars["exact_clamp_v"] = wrap[1] == Wrap::clamp_to_edge ? 1.0F : 0.0F;
  return out;
}

}  // namespace

const Method& exact_method() {
  static const Method method{
      .info = {.name = "exact",
               .summary = "The base BRDF summed over all texels under a kernel: what no stored NDF can beat.",
               .paper = "",
               .options = {word_option(
                               "kernel", {"filter", "pixel", "areas"},
                               "Which texels, with which weights: those that the footprint filter would blend; those "
                               "under the pixel's parallelogram as the reference draws them; those by the areas that "
                               "it cuts out of them."),
                           whole_option(
                               "texels", 128, 8, 512,
                               "The side of the largest square of texels under a pixel that is summed texel by texel; "
                               "of a larger one about as many are drawn, one from each cell.")},
               .honours = map_effects_but({}),
               .sums_environment = true,
               .slow_frame = true},
      .precompute = precompute,
      .shader = module_of(exact_glsl, "exact.glsl")};
  return method;
}

}  // namespace footprint
