// The document as JSON, in which a few members change; bytes come from the checked reader.
#include "renderer/baked_files/baked_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>

#include "renderer/core/bytes.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/files.hpp"
#include "renderer/core/names.hpp"
#include "renderer/image/image_io.hpp"
#include "renderer/scene/gltf/document.hpp"
#include "renderer/scene/gltf/material.hpp"

namespace footprint {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* dds_extension = "MSFT_texture_dds";

void use_extension(Json& document, const char* name) {
  Json& used = document["extensionsUsed"];
  if (std::ranges::find(used, Json(name)) == used.end()) used.push_back(name);
}

// Writes content of external files, or of the GLB's binary chunk, to new files next to the copy.
void move_beside(Json& object, const std::string& name, std::span<const std::uint8_t> bytes,
                 const std::filesystem::path& folder) {
  write_file_atomically(folder / name, bytes);
  object["uri"] = name;
}

const char* image_extension(std::span<const std::uint8_t> bytes) {
  if (bytes.size() > 11 && std::ranges::equal(bytes.subspan(8, 4), std::string_view("WEBP"))) return "webp";
  return bytes.size() > 2 && bytes[0] == 0xFF && bytes[1] == 0xD8 ? "jpg" : "png";
}

// Files that are missing stay so.
void move_resources(Json& copy, const GltfDocument& document, const std::filesystem::path& folder) {
  for (std::size_t i = 0; copy.contains("buffers") && i < copy["buffers"].size(); ++i) {
    Json& buffer = copy["buffers"][i];
    const std::vector<std::uint8_t>& bytes = document.model.buffers[i].data;
    if (!bytes.empty() && !buffer.value("uri", "").starts_with("data:"))
      move_beside(buffer, fmt::format("buffer{}.bin", i), bytes, folder);
  }
  for (std::size_t i = 0; copy.contains("images") && i < copy["images"].size(); ++i) {
    const GltfImage image = gltf_image(document, i);
    if (image.file.empty() || !std::filesystem::is_regular_file(image.file)) continue;
    const auto bytes = read_file_bytes(image.file, std::numeric_limits<std::int32_t>::max());
    move_beside(copy["images"][i], fmt::format("image{}.{}", i, image_extension(bytes)), bytes, folder);
  }
}

// names: of all materials, as the loader gives them.
Json& material_called(Json& document, const std::string& name, const std::vector<std::string>& names,
                      const std::string& source) {
  const auto found = std::ranges::find(names, name);
  if (found == names.end())
    throw Error(ErrorKind::usage, source, fmt::format("no material is called `{}`", name),
                "name one that the file has");
  return document["materials"][static_cast<std::size_t>(found - names.begin())];
}

PrefilteredTexture four_channels(std::vector<Image> chain) {
  const auto copy = [](const auto& in, const auto& out) { std::ranges::copy(in, out.begin()); };
  for (Image& level : chain) level = mapped(level, 4, copy, 1.0F);
  return make_texture("map", std::move(chain), Storage::unorm8, {});
}

std::size_t add_image(Json& document, const std::string& file, const char* type) {
  document["images"].push_back({{"uri", file}, {"mimeType", type}});
  return document["images"].size() - 1;
}

// Writes the files of a map and adds a texture of them; returns the texture's index.
std::size_t add_texture(Json& document, const std::string& stem, const std::vector<Image>& chain, const Json& sampler,
                        const std::filesystem::path& folder) {
  const PrefilteredTexture texels = four_channels(chain);
  write_png(folder / (stem + ".png"), chain.front());
  write_file_atomically(folder / (stem + ".dds"), dds_bytes(texels));
  write_file_atomically(folder / (stem + ".ktx2"), ktx2_bytes(texels));
  Json texture{{"source", add_image(document, stem + ".png", "image/png")}};
  if (!sampler.is_null()) texture["sampler"] = sampler;
  texture["extensions"][dds_extension]["source"] = add_image(document, stem + ".dds", "image/vnd-ms.dds");
  texture["extras"]["footprint_ktx2"] = stem + ".ktx2";
  use_extension(document, dds_extension);
  document["textures"].push_back(std::move(texture));
  return document["textures"].size() - 1;
}

// A texture reference that is looked up as the normal texture, but with another image.
Json looked_up_as(const Json& normal, std::size_t texture) {
  Json info{{"index", texture}};
  for (const char* member : {"texCoord", "extensions"}) {
    if (normal.contains(member)) info[member] = normal[member];
  }
  return info;
}

// names: of all materials of the document.
void replace(Json& document, const std::vector<std::string>& names, const ReplacedMaps& maps, const std::string& stem,
             const std::string& source, const std::filesystem::path& folder) {
  const Json& old = material_called(document, maps.material, names, source);
  if (old.contains("extensions") && old["extensions"].contains("KHR_materials_pbrSpecularGlossiness")) {
    throw Error(ErrorKind::usage, source,
                fmt::format("material `{}` stores its roughness as glossiness (KHR_materials_pbrSpecularGlossiness)",
                            maps.material),
                "convert the model to metallic-roughness, or leave --gltf out");
  }
  if (old.contains("extensions") && old["extensions"].contains("KHR_materials_anisotropy")) {
    throw Error(
        ErrorKind::usage, source,
        fmt::format("material `{}` is anisotropic (KHR_materials_anisotropy), and its baked roughness is that of "
                    "round lobes",
                    maps.material),
        "take the extension off the model, or leave --gltf out");
  }
  const Json normal = old.at("normalTexture");
  const Json& old_texture = document["textures"][normal["index"].get<std::size_t>()];
  const Json sampler = old_texture.contains("sampler") ? old_texture["sampler"] : Json();
  const std::size_t normal_texture = add_texture(document, stem + ".normal", maps.normal, sampler, folder);
  const std::size_t rough_texture =
      add_texture(document, stem + ".metallic_roughness", maps.rough_metallic, sampler, folder);
  Json& material = material_called(document, maps.material, names, source);
  if (!maps.anisotropy.empty()) {
    const std::size_t texture = add_texture(document, stem + ".anisotropy", maps.anisotropy, sampler, folder);
    use_extension(document, "KHR_materials_anisotropy");
    material["extensions"]["KHR_materials_anisotropy"] = {{"anisotropyStrength", 1.0},
                                                          {"anisotropyTexture", looked_up_as(normal, texture)}};
  }
  material["normalTexture"] = looked_up_as(normal, normal_texture);
  Json& surface = material["pbrMetallicRoughness"];
  surface["metallicRoughnessTexture"] = looked_up_as(normal, rough_texture);
  surface["roughnessFactor"] = 1.0;
  if (maps.metallic_in_map) surface["metallicFactor"] = 1.0;
}

}  // namespace

std::string write_gltf_copy(const std::filesystem::path& source, std::span<const ReplacedMaps> maps,
                            const std::filesystem::path& folder) {
  const GltfDocument document = read_gltf(source);
  // With the order of its members, and what compressed geometry was decoded from.
  Json json = Json::parse(gltf_text(read_file_bytes(source, std::numeric_limits<std::int32_t>::max())));
  normalize_gltf(json);
  move_resources(json, document, folder);
  std::vector<std::string> names;
  for (const ReplacedMaps& each : maps) names.push_back(each.material);
  const std::vector<std::string> stems = distinct_stems(names);
  const std::vector<std::string> materials = gltf_material_names(document);
  for (std::size_t i = 0; i < maps.size(); ++i) replace(json, materials, maps[i], stems[i], source.string(), folder);
  const std::string name = file_stem(source.stem().string()) + ".gltf";
  write_file_atomically(folder / name, json.dump(2) + "\n");
  return name;
}

}  // namespace footprint
