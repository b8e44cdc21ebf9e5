// Bytes, as engines keep them, made by the same encoder as every other texture.
#include "renderer/baked_files/engine_maps.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "renderer/bake/material_maps.hpp"
#include "renderer/bake/normal_chain.hpp"
#include "renderer/core/error.hpp"
#include "renderer/image/mipmap.hpp"

namespace footprint {
namespace {

// Where all normals of a texel cancel the surface's own stands in.
std::vector<Image> unit_normals(std::vector<Image> chain) {
  for (Image& level : chain) {
    for (std::size_t i = 0; i < level.texel_count(); ++i) {
      float* const n = &level.texels[3 * i];
      const float length = std::hypot(n[0], n[1], n[2]);
      const bool has_direction = length > 1e-6F;
      for (int c = 0; c < 3; ++c) n[c] = has_direction ? n[c] / length : (c == 2 ? 1.0F : 0.0F);
    }
  }
  return chain;
}

// The level of a chain for a map of that size: as large, or the next smaller one with each texel several times.
Image fitting(const std::vector<Image>& chain, int width, int height) {
  const auto level =
      std::ranges::find_if(chain, [&](const Image& each) { return each.width <= width && each.height <= height; });
  Image out(width, height, level->channels);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x)
      std::ranges::copy(level->at(x * level->width / width, y * level->height / height), out.at(x, y).begin());
  }
  return out;
}

}  // namespace

EngineMaps engine_maps(const BakedMethod& baked, const Material& material) {
  std::optional<std::vector<Image>> rough;
  try {
    rough = baked.method->roughness_mips(material, baked.options);
  } catch (const Error& error) {
    return {.textures = {}, .missing = error.message()};
  }
  if (!rough) return {};
  const TextureCoordinates coordinates = normal_coordinates(material);
  return {.textures = {make_texture("engine_normal", unit_normals(mean_normal_chain(material)), Storage::unorm8,
                                    coordinates, true),
                       make_texture("engine_roughness", *rough, Storage::unorm8, coordinates)},
          .missing = {}};
}

ReplacedMaps replaced_maps(const EngineMaps& maps, const Material& material, int level, std::vector<std::string> mips) {
  const PrefilteredTexture &normal = maps.textures.at(0), &rough = maps.textures.at(1);
  const std::size_t at = std::min(static_cast<std::size_t>(level), normal.levels.size() - 1);
  // Of a roughness map that is finer than the normal map the level as large as the normal map's; unless nothing is cut.
  const std::size_t finer = at == 0 ? 0 : rough.levels.size() - normal.levels.size();
  const Image roughness = decode_level(rough, at + finer);
  ReplacedMaps replaced{.material = material.name,
                        .normal = decode_level(normal, at),
                        .rough_metallic = Image(roughness.width, roughness.height, 3, 1.0F),
                        .metallic_in_map = metallic_map(material) != nullptr,
                        .roughness_mips = std::move(mips)};
  const Image metallic = fitting(mip_chain(metallic_map_of(material)), roughness.width, roughness.height);
  for (std::size_t i = 0; i < roughness.texel_count(); ++i) {
    replaced.rough_metallic.texels[3 * i + 1] = roughness.texels[i];
    if (replaced.metallic_in_map) replaced.rough_metallic.texels[3 * i + 2] = metallic.texels[i];
  }
  return replaced;
}

}  // namespace footprint
