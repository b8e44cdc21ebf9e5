// Chains by weighted means: invalid texels leave the mean of the others as it is.
#include "renderer/bake/normal_chain.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "renderer/bake/material_maps.hpp"
#include "renderer/bake/slope_moments.hpp"
#include "renderer/image/mipmap.hpp"

namespace footprint {
namespace {

// Decoded 8-bit normals are up to 0.6% too long or short, which would pass for spread or for a negative slope variance.
void renormalise(Image& normals) {
  for (std::size_t i = 0; i < normals.texels.size(); i += 4) {
    float* const n = &normals.texels[i];
    const float size = std::hypot(n[0], n[1], n[2]);
    if (size < 1e-3F) continue;  // the loader has given it weight 0
    for (int c = 0; c < 3; ++c) n[c] /= size;
  }
}

// x and y of the renormalised means.
std::vector<Image> sideways(std::vector<Image> chain) {
  for (Image& level : chain) {
    level = mapped(level, 2, [](const auto& n, const auto& out) {
      const float size = std::max(std::hypot(n[0], n[1], n[2]), 1e-6F);
      for (std::size_t c = 0; c < 2; ++c) out[c] = n[c] / size;
    });
  }
  return chain;
}

}  // namespace

std::vector<Image> mean_normal_chain(const Material& material) { return mean_normal_chain(normal_map_of(material)); }

std::vector<Image> mean_normal_chain(Image normals) {
  renormalise(normals);
  return channels_of(weighted_mip_chain(std::move(normals)), {0, 1, 2});
}

double shortfall_of_length(double length) {
  constexpr double rounding = 1.8e-7;
  const double shortfall = 1.0 - length;
  return shortfall <= rounding ? 0.0 : shortfall - rounding * (rounding / shortfall);
}

Prefiltered bake_mean_normal(const Material& material, Storage storage, const EffectSet& effects) {
  Prefiltered out;
  const auto add = [&](const char* name, std::vector<Image> chain, const TextureCoordinates& coordinates) {
    if (storage == Storage::bc5) chain = sideways(std::move(chain));
    out.textures.push_back(make_texture(name, std::move(chain), storage, coordinates, true));
  };
  if (has(effects, Effect::normal_variation))
    add("mean_normal", mean_normal_chain(material), normal_coordinates(material));
  if (has(effects, Effect::normal_layers))
    add("mean_layer", mean_normal_chain(layer_map_of(material)), layer_coordinates(material));
  return out;
}

Image lobe_variance_map(const Material& material) {
  const NormalDistribution distribution = material.brdf.distribution;
  Image variance = lobe_parameter_map_of(material);
  std::ranges::transform(variance.texels, variance.texels.begin(), [&](float parameter) {
    return lobe_variance({distribution, parameter});
  });
  return variance;
}

std::vector<Image> lobe_variance_chain(const Material& material) { return mip_chain(lobe_variance_map(material)); }

OptionSpec roughness_mean_option() {
  return word_option("roughness_mean", {"variance", "concentration"},
                     "What the roughness of a footprint is the mean of: slope variance, or its reciprocal, which keeps "
                     "the highlight's peak.");
}

RoughnessMean roughness_mean(const Options& options) {
  return options.word("roughness_mean") == "concentration" ? RoughnessMean::concentration : RoughnessMean::variance;
}

std::string stored_lobe_name(RoughnessMean mean) {
  return mean == RoughnessMean::concentration ? "lobe_concentration" : "lobe_variance";
}

float stored_roughness(float variance, RoughnessMean mean) {
  return mean == RoughnessMean::concentration ? stored_lobe_variance / variance : variance / stored_lobe_variance;
}

Prefiltered bake_lobe_variance(const Material& material, Storage storage, const EffectSet& effects,
                               RoughnessMean mean) {
  Prefiltered out;
  if (!has(effects, Effect::roughness_variation)) return out;
  Image finest = lobe_variance_map(material);
  for (float& v : finest.texels) v = stored_roughness(v, mean);
  out.textures.push_back(make_texture(stored_lobe_name(mean), mip_chain(finest),
                                      is_coarse(storage) ? Storage::fp16 : storage, roughness_coordinates(material)));
  return out;
}

Prefiltered bake_mean_roughness(const Material& material, Storage storage, const EffectSet& effects) {
  Prefiltered out;
  if (has(effects, Effect::roughness_variation)) {
    out.textures.push_back(make_texture("mean_roughness", mip_chain(roughness_map_of(material)),
                                        is_block(storage) ? Storage::bc4 : storage, roughness_coordinates(material)));
  }
  return out;
}

OptionSpec storage_option() {
  return word_option("storage", {"fp32", "fp16", "unorm8"},
                     "How the baked textures are stored: 32-bit floats, 16-bit floats or 8-bit fixed point.");
}

OptionSpec block_storage_option(bool renormalises) {
  std::vector<std::string> words{"fp32", "fp16", "unorm8", "bc1"};
  if (renormalises) words.emplace_back("bc5");
  return word_option("storage", std::move(words),
                     "How the baked textures are stored: 32-bit floats, 16-bit floats, 8-bit fixed point, or normals "
                     "in blocks of 4 x 4 texels.");
}

OptionSpec float_storage_option() {
  return word_option("storage", {"fp32", "fp16"}, "How the baked textures are stored: 32-bit floats or 16-bit floats.");
}

}  // namespace footprint
