// Mip chains of normals, of what a preset makes of their lengths, and of the roughness.
#include "methods/roughness_bake/baked_maps.hpp"

#include <cmath>
#include <utility>

#include "renderer/bake/material_maps.hpp"
#include "renderer/bake/normal_chain.hpp"
#include "renderer/image/mipmap.hpp"

namespace footprint::roughness_bake {
namespace {

// Bytes hold no sum of variances.
Storage spread_storage(Storage storage) { return storage == Storage::unorm8 ? Storage::fp16 : storage; }

}  // namespace

std::vector<Image> spread_chain(Image normals, Preset preset) {
  std::vector<Image> chain;
  for (const Image& level : mean_normal_chain(std::move(normals))) {
    const bool finest = chain.empty();
    Image& out = chain.emplace_back(level.width, level.height, 1);
    for (std::size_t i = 0; i < level.texel_count(); ++i) {
      const float* const n = &level.texels[3 * i];
      const double length = std::hypot(double{n[0]}, double{n[1]}, double{n[2]});
      const double shortfall = shortfall_of_length(length);
      if (finest && shortfall == 0.0) continue;  // Filament's finest level is the roughness as given
      out.texels[i] = static_cast<float>(stored_spread(preset, shortfall));
    }
  }
  return chain;
}

Prefiltered bake_mean_roughness(const Material& material, Storage storage, const EffectSet& effects) {
  Prefiltered out;
  if (has(effects, Effect::roughness_variation)) {
    out.textures.push_back(make_texture("baked_roughness", mip_chain(roughness_map_of(material)), storage,
                                        roughness_coordinates(material)));
  }
  return out;
}

Prefiltered bake_roughness(const Material& material, Preset preset, Storage storage, const EffectSet& effects) {
  const Storage wide = spread_storage(storage);
  Prefiltered out = bake_mean_normal(material, storage, effects);
  if (has(effects, Effect::normal_variation)) {
    out.textures.push_back(make_texture("normal_spread", spread_chain(normal_map_of(material), preset), wide,
                                        normal_coordinates(material)));
  }
  if (has(effects, Effect::normal_layers)) {
    out.textures.push_back(
        make_texture("layer_spread", spread_chain(layer_map_of(material), preset), wide, layer_coordinates(material)));
  }
  for (PrefilteredTexture& texture : bake_mean_roughness(material, storage, effects).textures)
    out.textures.push_back(std::move(texture));
  return out;
}

}  // namespace footprint::roughness_bake
