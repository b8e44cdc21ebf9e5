// Names the files, and writes each texture in every format that can store it.
#include "renderer/baked_files/baked_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "renderer/bake/material_maps.hpp"
#include "renderer/bake/normal_chain.hpp"
#include "renderer/bake/slope_moments.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/files.hpp"
#include "renderer/core/names.hpp"
#include "renderer/core/process.hpp"
#include "renderer/image/image_io.hpp"
#include "renderer/image/mipmap.hpp"

namespace footprint {
namespace {

// If the normals of a texel cancel, the surface's own replaces them.
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
  return nearest_texels(*level, width, height);
}

// A level as glTF has it: 1, roughness and, if it is in a map, metallic.
Image joined(const Image& roughness, const std::vector<Image>& metallic, bool metallic_in_map) {
  Image out(roughness.width, roughness.height, 3, 1.0F);
  const Image fit = fitting(metallic, roughness.width, roughness.height);
  for (std::size_t i = 0; i < roughness.texel_count(); ++i) {
    out.texels[3 * i + 1] = roughness.texels[i];
    if (metallic_in_map) out.texels[3 * i + 2] = fit.texels[i];
  }
  return out;
}

// PNG has no two channels that every reader takes for two numbers.
bool fits_png(const PrefilteredTexture& texture) { return texture.storage == Storage::unorm8 && texture.channels != 2; }

TextureFiles files_of(const PrefilteredTexture& texture, const std::string& folder) {
  TextureFiles files{.exr = {}, .ktx2 = fmt::format("{}/{}.ktx2", folder, texture.name), .png = {}};
  for (int layer = 0; layer < std::max(texture.layers, 1); ++layer) {
    const std::string part = texture.layers > 0 ? fmt::format(".layer{}", layer) : std::string();
    files.exr.push_back(fmt::format("{}/{}{}.exr", folder, texture.name, part));
    for (std::size_t level = 0; fits_png(texture) && level < texture.levels.size(); ++level)
      files.png.push_back(fmt::format("{}/{}{}.mip{}.png", folder, texture.name, part, level));
  }
  return files;
}

std::vector<std::string> channel_names(int channels) {
  if (channels == 1) return {"Y"};
  constexpr std::array<const char*, 4> names{"R", "G", "B", "A"};
  return {names.begin(), names.begin() + channels};
}

std::vector<Image> decoded_chain(const PrefilteredTexture& texture, int layer) {
  std::vector<Image> chain;
  for (std::size_t level = 0; level < texture.levels.size(); ++level)
    chain.push_back(decode_level(texture, level, layer));
  return chain;
}

void write_texture(const PrefilteredTexture& texture, const TextureFiles& files, const std::filesystem::path& folder) {
  const ExrTexel texel = texture.storage == Storage::fp16 ? ExrTexel::half : ExrTexel::full;
  auto png = files.png.begin();
  for (int layer = 0; layer < std::max(texture.layers, 1); ++layer) {
    throw_if_interrupted();
    const ExrChain chain{.levels = decoded_chain(texture, layer), .channels = channel_names(texture.channels)};
    write_exr_chain(folder / files.exr.at(static_cast<std::size_t>(layer)), chain, texel);
    for (std::size_t level = 0; !files.png.empty() && level < chain.levels.size(); ++level)
      write_png(folder / *png++, chain.levels[level]);
  }
  write_file_atomically(folder / files.ktx2, ktx2_bytes(texture));
}

void write_textures(const std::vector<PrefilteredTexture>& textures, const std::vector<TextureFiles>& files,
                    const std::filesystem::path& folder) {
  for (std::size_t t = 0; t < textures.size(); ++t) write_texture(textures[t], files[t], folder);
}

// Whether moments of slope contain only slopes: with `roughness=moments` they include the base lobe.
bool holds_slopes_alone(const BakedMethod& baked, std::size_t material) {
  const auto& options = baked.options.all();
  const auto roughness = options.find("roughness");
  const bool joined = roughness != options.end() && roughness->second == std::variant<double, std::string>("moments");
  return holds_slope_moments(baked.materials[material]) && !joined;
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
  EngineMaps maps;
  const auto add = [&](const char* name, std::vector<Image> chain, bool signed_range = false) {
    maps.textures.push_back(
        make_texture(name, std::move(chain), Storage::unorm8, normal_coordinates(material), signed_range));
  };
  const bool has_direction = rough->front().channels > 1;
  add("engine_normal", unit_normals(mean_normal_chain(material)), true);
  add("engine_roughness", has_direction ? channels_of(*rough, {3}) : *rough);
  if (has_direction) add("engine_anisotropy", channels_of(*rough, {0, 1, 2}));
  return maps;
}

ReplacedMaps replaced_maps(const EngineMaps& maps, const Material& material, int level) {
  const PrefilteredTexture &normal = maps.textures.at(0), &rough = maps.textures.at(1);
  const std::size_t at = std::min(static_cast<std::size_t>(level), normal.levels.size() - 1);
  // A roughness map that is finer than the normal map begins at the normal map's size, unless nothing is cut.
  const std::size_t finer = at == 0 ? 0 : rough.levels.size() - normal.levels.size();
  ReplacedMaps replaced{.material = material.name,
                        .normal = {},
                        .rough_metallic = {},
                        .anisotropy = {},
                        .metallic_in_map = metallic_map(material) != nullptr};
  for (std::size_t l = at; l < normal.levels.size(); ++l) replaced.normal.push_back(decode_level(normal, l));
  const std::vector<Image> metallic = mip_chain(metallic_map_of(material));
  for (std::size_t l = at + finer; l < rough.levels.size(); ++l)
    replaced.rough_metallic.push_back(joined(decode_level(rough, l), metallic, replaced.metallic_in_map));
  for (std::size_t l = at + finer; maps.textures.size() > 2 && l < rough.levels.size(); ++l)
    replaced.anisotropy.push_back(decode_level(maps.textures[2], l));
  return replaced;
}

BakeListing list_bake(const BakeToFiles& bake) {
  std::vector<std::string> names;
  for (const Material& material : bake.scene.materials) names.push_back(material.name);
  const std::vector<std::string> folders = distinct_stems(names);
  const std::string& name = bake.baked.method->info.name;
  BakeListing listing{.module = name + ".glsl", .shaders = {}, .materials = {}};
  for (const ShaderLanguage language : bake.languages) listing.shaders.push_back(name + "." + file_extension(language));
  for (std::size_t i = 0; i < folders.size(); ++i) {
    const std::string folder = "maps/" + folders[i];
    MaterialFiles& files = listing.materials.emplace_back();
    files.folder = folders[i];
    for (const PrefilteredTexture& texture : bake.baked.materials.at(i).textures)
      files.textures.push_back(files_of(texture, folder));
    if (i < bake.engine.size()) {
      for (const PrefilteredTexture& texture : bake.engine[i].textures)
        files.imports.push_back(files_of(texture, folder));
    }
    if (holds_slopes_alone(bake.baked, i)) files.bumpslopes = folder + "/bumpslopes.exr";
  }
  return listing;
}

void require_files(const BakeToFiles& bake) {
  std::size_t count = 0;
  for (const Prefiltered& prefiltered : bake.baked.materials) {
    count += prefiltered.textures.size();
    if (std::ranges::any_of(prefiltered.textures, &PrefilteredTexture::built))
      throw std::logic_error("a texture waits for its frame build");
  }
  if (count > 0 || bake.baked.method->info.screen_derivatives) return;  // screen derivatives contain curvature too
  throw Error(ErrorKind::usage, fmt::format("{}, method {}", bake.scene.source, bake.baked.spec.text),
              "bakes nothing: normals and roughness do not vary on any material", "give a model with a normal map");
}

void write_bake(const BakeToFiles& bake, const std::filesystem::path& folder) {
  require_files(bake);
  const BakeListing listing = list_bake(bake);
  for (std::size_t i = 0; i < listing.materials.size(); ++i) {
    const MaterialFiles& files = listing.materials[i];
    const Prefiltered& prefiltered = bake.baked.materials[i];
    if (!prefiltered.textures.empty()) std::filesystem::create_directories(folder / "maps" / files.folder);
    write_textures(prefiltered.textures, files.textures, folder);
    if (i < bake.engine.size()) write_textures(bake.engine[i].textures, files.imports, folder);
    if (!files.bumpslopes) continue;
    const bool halves = prefiltered.textures.front().storage == Storage::fp16;
    write_exr_chain(folder / *files.bumpslopes, *make_bumpslopes(prefiltered),
                    halves ? ExrTexel::half : ExrTexel::full);
  }
  write_file_atomically(folder / listing.module, module_text(bake));
  for (std::size_t i = 0; i < listing.shaders.size(); ++i)
    write_file_atomically(folder / listing.shaders[i], shader_text(bake, bake.languages[i]));
  write_file_atomically(folder / "manifest.json", manifest_json(bake, listing));
}

}  // namespace footprint
