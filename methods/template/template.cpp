// `template`: a method to copy. One lobe about the mean normal, widened as if the normals of different texels were
// independent. N of them then have, on average, 1 - 1/N of the spread of the whole map.
#include <algorithm>
#include <cmath>
#include <span>

#include "renderer/bake/material_maps.hpp"
#include "renderer/bake/method.hpp"
#include "renderer/bake/normal_chain.hpp"

namespace footprint {

// The texts of this folder, which footprint_add_method embeds under this name.
extern const EmbeddedTexts template_glsl;

namespace {

// The slope variance per axis of normals whose mean is `mean` (Toksvig 2005: 1/s' - 1/s).
float spread_of(std::span<const float> mean) {
  const float consistency = std::min(std::hypot(mean[0], mean[1], mean[2]), 1.0F);  // rounding leaves more than 1
  return (1.0F - consistency) / std::max(consistency, 1e-3F);  // normals that cancel have no mean: stay finite
}

// Four channels: the mean normal, and the expected spread among the texels that a texel of this level covers.
std::vector<Image> normal_and_spread(const Material& material) {
  const std::vector<Image> normals = mean_normal_chain(material);
  const float whole_spread = spread_of(normals.back().at(0, 0));
  const auto texels = static_cast<float>(normals.front().texel_count());
  std::vector<Image> chain;
  for (const Image& level : normals) {
    const float share = 1.0F - static_cast<float>(level.texel_count()) / texels;
    Image& out = chain.emplace_back(level.width, level.height, 4, share * whole_spread);
    for (std::size_t i = 0; i < level.texel_count(); ++i) std::copy_n(&level.texels[3 * i], 3, &out.texels[4 * i]);
  }
  return chain;
}

Prefiltered precompute(const Material& material, const Options& /*options*/, const EffectSet& effects,
                       const Progress& /*progress*/) {
  Prefiltered out;
  out.scalars["template_lobe"] = static_cast<float>(mean_lobe(material).parameter);
  if (has(effects, Effect::normal_variation)) {
    out.textures.push_back(
        make_texture("template_normal", normal_and_spread(material), Storage::fp32, normal_coordinates(material)));
  }
  return out;
}

}  // namespace

const Method& template_method() {
  static const Method method{
      .info = {.name = "template",
               .summary = "One lobe about the mean normal, widened as if texels were independent.",
               .paper = "none: an example to copy",
               .options = {number_option("share", 1.0, 0.0, 4.0,
                                         "Factor on the spread that is added to the lobe's slope variance per axis; "
                                         "0 leaves the base lobe as it is.")},
               .honours =
                   map_effects_but({Effect::anisotropic_lobe, Effect::normal_layers, Effect::roughness_variation})},
      .precompute = precompute,
      .shader = module_of(template_glsl, "template.glsl")};
  return method;
}

}  // namespace footprint
