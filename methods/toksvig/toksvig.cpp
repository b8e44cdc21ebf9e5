// `toksvig`: the length of the mean normal under a footprint gives the spread of the normals. One lobe about the mean
// normal is widened by that spread. Toksvig 2004/2005, "Mipmapping Normal Maps".
#include <algorithm>

#include "renderer/bake/method.hpp"
#include "renderer/bake/normal_chain.hpp"

namespace footprint {

extern const EmbeddedTexts toksvig_glsl;

namespace {

Prefiltered precompute(const Material& material, const Options& options, const EffectSet& effects,
                       const Progress& /*progress*/) {
  const Storage storage = parse_storage(options.word("storage"));
  Prefiltered out = bake_mean_normal(material, storage, effects);
  append(out.textures, bake_lobe_variance(material, storage, effects, roughness_mean(options)).textures);
  return out;
}

}  // namespace

const Method& toksvig_method() {
  static const Method method{
      .info =
          {.name = "toksvig",
           .summary = "One lobe about the mean normal, widened according to the length of the mean normal.",
           .paper = "Toksvig 2005, Mipmapping Normal Maps, Journal of Graphics Tools 10(3)",
           .options = {storage_option(), roughness_mean_option(),
                       number_option(
                           "spread", 1.0, 0.0, 4.0,
                           "Factor on the spread (1 - |Na|) / |Na| before it is added to the lobe's slope variance per "
                           "axis; 1 is Toksvig's. Engines' recipes for alpha^2 differ: alpha^2 += 2 spread / kappa."),
                       word_option(
                           "diffuse", {"mean", "normalized"},
                           "The diffuse term's normal: the mean normal, whose dot product is the mean of the facets' "
                           "own while all face the light, or the renormalised one.")},
           .honours = map_effects_but({Effect::anisotropic_lobe})},
      .precompute = precompute,
      .shader = module_of(toksvig_glsl, "toksvig.glsl")};
  return method;
}

}  // namespace footprint
