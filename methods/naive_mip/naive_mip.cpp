// `naive_mip`: the mean normal, renormalised, and the mean roughness, as most renderers use them. Distant surfaces
// become too shiny, because the spread of the normals is lost.
#include "renderer/bake/material_maps.hpp"
#include "renderer/bake/method.hpp"
#include "renderer/bake/normal_chain.hpp"
#include "renderer/core/error.hpp"
#include "renderer/image/mipmap.hpp"

namespace footprint {

extern const EmbeddedTexts naive_mip_glsl;

namespace {

Prefiltered precompute(const Material& material, const Options& options, const EffectSet& effects,
                       const Progress& /*progress*/) {
  const Storage storage = parse_storage(options.word("storage"));
  Prefiltered out = bake_mean_normal(material, storage, effects);
  if (!has(effects, Effect::roughness_variation)) return out;
  const bool lobe = options.word("averages") == "lobe";
  if (lobe && storage == Storage::unorm8) {
    throw Error(ErrorKind::usage, "naive_mip", "storage=unorm8 cannot store lobe parameters",
                "give storage=fp32 or storage=fp16, or averages=roughness");
  }
  const Image map = lobe ? lobe_parameter_map_of(material) : roughness_map_of(material);
  out.textures.push_back(
      make_texture(lobe ? "naive_lobe" : "naive_roughness", mip_chain(map), storage, roughness_coordinates(material)));
  return out;
}

}  // namespace

const Method& naive_mip_method() {
  static const Method method{
      .info = {.name = "naive_mip",
               .summary = "Mip maps of normal and roughness: the mean normal, renormalised, and the mean roughness.",
               .paper = "Williams 1983, Pyramidal Parametrics (the mip map itself)",
               .options = {storage_option(),
                           word_option(
                               "averages", {"roughness", "lobe"},
                               "What of a varying lobe is averaged: the perceptual roughness, as a texture stores it, "
                               "or the lobe's own parameter (exponent, alpha, kappa), as Xu 2017 does.")},
               .honours = map_effects_but({})},
      .precompute = precompute,
      .shader = module_of(naive_mip_glsl, "naive_mip.glsl")};
  return method;
}

}  // namespace footprint
