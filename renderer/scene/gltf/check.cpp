// One table of rules says what each member must be; a walker applies them.
#include "renderer/scene/gltf/check.hpp"

#include <fmt/format.h>
#include <tiny_gltf.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "renderer/scene/gltf/refusal.hpp"

namespace footprint {
namespace {

using nlohmann::json;

enum class JsonKind {
  object,
  array,
  string,
  boolean,
  number,
  numbers,  ///< an array of `count` numbers
  size,     ///< a whole number from 0 to 2^31 - 1
  index,    ///< a position in the array `target`
};

enum class Need { optional, required };

/// What the members that `path` names must be: "[]" stands for every element, "*" for every member.
struct Rule {
  std::string_view path;
  JsonKind kind;
  Need need = Need::optional;
  std::string_view target{};
  std::size_t count = 0;
};

constexpr std::string_view lights = "extensions.KHR_lights_punctual.lights";
constexpr std::string_view variants = "extensions.KHR_materials_variants.variants";

constexpr auto rules = std::to_array<Rule>({
    {"extensionsUsed[]", JsonKind::string},
    {"extensionsRequired[]", JsonKind::string},
    {"extensions", JsonKind::object},
    {"scene", JsonKind::index, Need::optional, "scenes"},
    {"scenes[]", JsonKind::object},
    {"scenes[].nodes[]", JsonKind::index, Need::optional, "nodes"},
    {"nodes[]", JsonKind::object},
    {"nodes[].name", JsonKind::string},
    {"nodes[].children[]", JsonKind::index, Need::optional, "nodes"},
    {"nodes[].mesh", JsonKind::index, Need::optional, "meshes"},
    {"nodes[].camera", JsonKind::index, Need::optional, "cameras"},
    {"nodes[].skin", JsonKind::index, Need::optional, "skins"},
    {"nodes[].matrix", JsonKind::numbers, Need::optional, "", 16},
    {"nodes[].translation", JsonKind::numbers, Need::optional, "", 3},
    {"nodes[].rotation", JsonKind::numbers, Need::optional, "", 4},
    {"nodes[].scale", JsonKind::numbers, Need::optional, "", 3},
    {"nodes[].extensions", JsonKind::object},
    {"nodes[].extensions.KHR_lights_punctual.light", JsonKind::index, Need::required, lights},
    {"meshes[]", JsonKind::object},
    {"meshes[].name", JsonKind::string},
    {"meshes[].primitives", JsonKind::array, Need::required},
    {"meshes[].primitives[]", JsonKind::object},
    {"meshes[].primitives[].attributes", JsonKind::object, Need::required},
    {"meshes[].primitives[].attributes.*", JsonKind::index, Need::optional, "accessors"},
    {"meshes[].primitives[].indices", JsonKind::index, Need::optional, "accessors"},
    {"meshes[].primitives[].material", JsonKind::index, Need::optional, "materials"},
    {"meshes[].primitives[].mode", JsonKind::size},
    {"meshes[].primitives[].extensions", JsonKind::object},
    {"meshes[].primitives[].extensions.KHR_materials_variants", JsonKind::object},
    {"meshes[].primitives[].extensions.KHR_materials_variants.mappings", JsonKind::array, Need::required},
    {"meshes[].primitives[].extensions.KHR_materials_variants.mappings[]", JsonKind::object},
    {"meshes[].primitives[].extensions.KHR_materials_variants.mappings[].material", JsonKind::index, Need::required,
     "materials"},
    {"meshes[].primitives[].extensions.KHR_materials_variants.mappings[].variants", JsonKind::array, Need::required},
    {"meshes[].primitives[].extensions.KHR_materials_variants.mappings[].variants[]", JsonKind::index, Need::optional,
     variants},
    {"meshes[].primitives[].extensions.KHR_draco_mesh_compression", JsonKind::object},
    {"meshes[].primitives[].extensions.KHR_draco_mesh_compression.bufferView", JsonKind::index, Need::required,
     "bufferViews"},
    {"meshes[].primitives[].extensions.KHR_draco_mesh_compression.attributes", JsonKind::object, Need::required},
    {"meshes[].primitives[].extensions.KHR_draco_mesh_compression.attributes.*", JsonKind::size},
    {"accessors[]", JsonKind::object},
    {"accessors[].bufferView", JsonKind::index, Need::optional, "bufferViews"},
    {"accessors[].byteOffset", JsonKind::size},
    {"accessors[].componentType", JsonKind::size, Need::required},
    {"accessors[].normalized", JsonKind::boolean},
    {"accessors[].count", JsonKind::size, Need::required},
    {"accessors[].type", JsonKind::string, Need::required},
    {"accessors[].sparse", JsonKind::object},
    {"accessors[].sparse.count", JsonKind::size, Need::required},
    {"accessors[].sparse.indices", JsonKind::object, Need::required},
    {"accessors[].sparse.indices.bufferView", JsonKind::index, Need::required, "bufferViews"},
    {"accessors[].sparse.indices.byteOffset", JsonKind::size},
    {"accessors[].sparse.indices.componentType", JsonKind::size, Need::required},
    {"accessors[].sparse.values", JsonKind::object, Need::required},
    {"accessors[].sparse.values.bufferView", JsonKind::index, Need::required, "bufferViews"},
    {"accessors[].sparse.values.byteOffset", JsonKind::size},
    {"bufferViews[]", JsonKind::object},
    {"bufferViews[].buffer", JsonKind::index, Need::required, "buffers"},
    {"bufferViews[].byteOffset", JsonKind::size},
    {"bufferViews[].byteLength", JsonKind::size, Need::required},
    {"bufferViews[].byteStride", JsonKind::size},
    {"bufferViews[].extensions", JsonKind::object},
    {"bufferViews[].extensions.EXT_meshopt_compression", JsonKind::object},
    {"bufferViews[].extensions.EXT_meshopt_compression.buffer", JsonKind::index, Need::required, "buffers"},
    {"bufferViews[].extensions.EXT_meshopt_compression.byteOffset", JsonKind::size},
    {"bufferViews[].extensions.EXT_meshopt_compression.byteLength", JsonKind::size, Need::required},
    {"bufferViews[].extensions.EXT_meshopt_compression.byteStride", JsonKind::size, Need::required},
    {"bufferViews[].extensions.EXT_meshopt_compression.count", JsonKind::size, Need::required},
    {"bufferViews[].extensions.EXT_meshopt_compression.mode", JsonKind::string, Need::required},
    {"bufferViews[].extensions.EXT_meshopt_compression.filter", JsonKind::string},
    {"buffers[]", JsonKind::object},
    {"buffers[].byteLength", JsonKind::size, Need::required},
    {"buffers[].uri", JsonKind::string},
    {"images[]", JsonKind::object},
    {"images[].name", JsonKind::string},
    {"images[].uri", JsonKind::string},
    {"images[].bufferView", JsonKind::index, Need::optional, "bufferViews"},
    {"textures[]", JsonKind::object},
    {"textures[].source", JsonKind::index, Need::optional, "images"},
    {"textures[].sampler", JsonKind::index, Need::optional, "samplers"},
    {"samplers[]", JsonKind::object},
    {"samplers[].wrapS", JsonKind::size},
    {"samplers[].wrapT", JsonKind::size},
    {"materials[]", JsonKind::object},
    {"materials[].name", JsonKind::string},
    {"materials[].doubleSided", JsonKind::boolean},
    {"materials[].alphaMode", JsonKind::string},
    {"materials[].alphaCutoff", JsonKind::number},
    {"materials[].emissiveFactor", JsonKind::numbers, Need::optional, "", 3},
    {"materials[].extensions", JsonKind::object},
    {"materials[].extensions.*", JsonKind::object},
    {"materials[].extensions.KHR_materials_ior.ior", JsonKind::number},
    {"materials[].extensions.KHR_materials_clearcoat.clearcoatFactor", JsonKind::number},
    {"materials[].extensions.KHR_materials_clearcoat.clearcoatRoughnessFactor", JsonKind::number},
    {"materials[].extensions.KHR_materials_clearcoat.clearcoatNormalTexture.scale", JsonKind::number},
    {"materials[].pbrMetallicRoughness", JsonKind::object},
    {"materials[].pbrMetallicRoughness.baseColorFactor", JsonKind::numbers, Need::optional, "", 4},
    {"materials[].pbrMetallicRoughness.metallicFactor", JsonKind::number},
    {"materials[].pbrMetallicRoughness.roughnessFactor", JsonKind::number},
    {"materials[].normalTexture.scale", JsonKind::number},
    {"cameras[]", JsonKind::object},
    {"cameras[].type", JsonKind::string, Need::required},
    {"cameras[].perspective", JsonKind::object},
    {"cameras[].perspective.*", JsonKind::number},
    {"cameras[].orthographic", JsonKind::object},
    {"cameras[].orthographic.*", JsonKind::number},
    {"extensions.KHR_lights_punctual", JsonKind::object},
    {"extensions.KHR_lights_punctual.lights", JsonKind::array, Need::required},
    {"extensions.KHR_lights_punctual.lights[]", JsonKind::object},
    {"extensions.KHR_lights_punctual.lights[].type", JsonKind::string, Need::required},
    {"extensions.KHR_lights_punctual.lights[].color", JsonKind::numbers, Need::optional, "", 3},
    {"extensions.KHR_lights_punctual.lights[].intensity", JsonKind::number},
    {"extensions.KHR_lights_punctual.lights[].range", JsonKind::number},
    {"extensions.KHR_lights_punctual.lights[].spot", JsonKind::object},
    {"extensions.KHR_lights_punctual.lights[].spot.*", JsonKind::number},
    {"extensions.KHR_materials_variants", JsonKind::object},
    {"extensions.KHR_materials_variants.variants", JsonKind::array, Need::required},
    {"extensions.KHR_materials_variants.variants[]", JsonKind::object},
    {"extensions.KHR_materials_variants.variants[].name", JsonKind::string},
    {"scenes[].name", JsonKind::string},
    {"cameras[].name", JsonKind::string},
    {"animations[]", JsonKind::object},
    {"animations[].channels[]", JsonKind::object},
    {"animations[].samplers[]", JsonKind::object},
    {"skins[]", JsonKind::object},
});

constexpr auto texture_paths = std::to_array<std::string_view>({
    "materials[].pbrMetallicRoughness.baseColorTexture",
    "materials[].pbrMetallicRoughness.metallicRoughnessTexture",
    "materials[].normalTexture",
    "materials[].occlusionTexture",
    "materials[].emissiveTexture",
    "materials[].extensions.KHR_materials_clearcoat.clearcoatTexture",
    "materials[].extensions.KHR_materials_clearcoat.clearcoatRoughnessTexture",
    "materials[].extensions.KHR_materials_clearcoat.clearcoatNormalTexture",
});

/// What stands under each of `texture_paths`.
constexpr auto texture_rules = std::to_array<Rule>({
    {"", JsonKind::object},
    {".index", JsonKind::index, Need::required, "textures"},
    {".texCoord", JsonKind::size},
    {".extensions", JsonKind::object},
    {".extensions.KHR_texture_transform", JsonKind::object},
    {".extensions.KHR_texture_transform.offset", JsonKind::numbers, Need::optional, "", 2},
    {".extensions.KHR_texture_transform.rotation", JsonKind::number},
    {".extensions.KHR_texture_transform.scale", JsonKind::numbers, Need::optional, "", 2},
    {".extensions.KHR_texture_transform.texCoord", JsonKind::size},
});

constexpr auto supported = std::to_array<std::string_view>(
    {"EXT_meshopt_compression", "KHR_draco_mesh_compression", "KHR_lights_punctual", "KHR_materials_clearcoat",
     "KHR_materials_ior", "KHR_materials_variants", "KHR_mesh_quantization", "KHR_texture_transform"});

/// An extension, and what it is in words.
struct ExtensionWord {
  std::string_view name, meaning;
};

/// Those that add something to a surface which is whole without it.
constexpr auto layers = std::to_array<ExtensionWord>({
    {"KHR_materials_anisotropy", "anisotropy"},
    {"KHR_materials_diffuse_transmission", "diffuse transmission"},
    {"KHR_materials_dispersion", "dispersion"},
    {"KHR_materials_emissive_strength", "the strength of emissive light"},
    {"KHR_materials_iridescence", "iridescence"},
    {"KHR_materials_sheen", "sheen"},
    {"KHR_materials_specular", "the strength and colour of the specular term"},
    {"KHR_materials_transmission", "transmission"},
    {"KHR_materials_volume", "the volume under the surface"},
});

/// Ways to store a file that are not read.
constexpr auto encodings = std::to_array<ExtensionWord>({
    {"EXT_texture_webp", "WebP textures"},
    {"KHR_texture_basisu", "KTX2 textures (Basis Universal)"},
});

template <std::size_t count>
std::string_view meaning_of(std::string_view name, const std::array<ExtensionWord, count>& known) {
  const auto found = std::ranges::find(known, name, &ExtensionWord::name);
  return found == known.end() ? std::string_view{} : found->meaning;
}

std::size_t array_size(const json& document, std::string_view path) {
  const json* value = &document;
  while (!path.empty()) {
    const auto dot = path.find('.');
    const std::string key{path.substr(0, dot)};
    if (!value->is_object() || !value->contains(key)) return 0;
    value = &(*value)[key];
    path = dot == std::string_view::npos ? std::string_view{} : path.substr(dot + 1);
  }
  return value->is_array() ? value->size() : 0;
}

void check_numbers(const json& value, std::size_t count, const std::string& where) {
  if (!value.is_array() || value.size() != count || !std::ranges::all_of(value, &json::is_number)) {
    refuse_gltf(where, fmt::format("must be an array of {} numbers", count));
  }
}

void check_whole(const json& value, std::uint64_t end, const std::string& where, std::string_view target) {
  if (!value.is_number_integer()) refuse_gltf(where, "must be a whole number");
  const bool negative = !value.is_number_unsigned() && value.get<std::int64_t>() < 0;
  if (negative || value.get<std::uint64_t>() >= end) {
    refuse_gltf(where, target.empty()
                           ? fmt::format("{} is not within 0 to {}", value.dump(), end - 1)
                           : fmt::format("index {} is out of range: `{}` has {}", value.dump(), target, end));
  }
}

void check_value(const json& value, const Rule& rule, const std::string& where, std::uint64_t end) {
  switch (rule.kind) {
    case JsonKind::object:
      if (!value.is_object()) refuse_gltf(where, "must be an object");
      break;
    case JsonKind::array:
      if (!value.is_array()) refuse_gltf(where, "must be an array");
      break;
    case JsonKind::string:
      if (!value.is_string()) refuse_gltf(where, "must be a string");
      break;
    case JsonKind::boolean:
      if (!value.is_boolean()) refuse_gltf(where, "must be true or false");
      break;
    case JsonKind::number:
      if (!value.is_number()) refuse_gltf(where, "must be a number");
      break;
    case JsonKind::numbers:
      check_numbers(value, rule.count, where);
      break;
    case JsonKind::size:
    case JsonKind::index:
      check_whole(value, end, where, rule.target);
      break;
  }
}

/// Applies `rule` to what `path` (the rest of its path) names below `value`. `where` is a stack of place names: it is
/// joined only for an error, as large files have many places and few errors.
void walk(const json& value, std::string_view path, const Rule& rule, std::uint64_t end, std::string& where) {
  if (path.empty()) return check_value(value, rule, where, end);
  const std::size_t depth = where.size();
  const auto descend = [&](const json& child, const std::string& name, std::string_view rest) {
    where += name;
    walk(child, rest, rule, end, where);
    where.resize(depth);
  };
  if (path.starts_with("[]")) {
    if (!value.is_array()) refuse_gltf(where, "must be an array");
    for (std::size_t i = 0; i < value.size(); ++i) descend(value[i], fmt::format("[{}]", i), path.substr(2));
    return;
  }
  if (path.front() == '.') path.remove_prefix(1);
  if (!value.is_object()) refuse_gltf(where, "must be an object");
  if (path.front() == '*') {
    for (const auto& [key, child] : value.items()) {
      // Extension and extra data are no member of the parent's own kind.
      if (child.is_object() && (key == "extensions" || key == "extras")) continue;
      if (key != "extras") descend(child, (depth == 0 ? "" : ".") + key, path.substr(1));
    }
    return;
  }
  const auto name_end = std::min(path.find_first_of(".["), path.size());
  const std::string name{path.substr(0, name_end)};
  const auto member = value.find(name);
  const std::string dotted = (depth == 0 ? "" : ".") + name;
  if (member != value.end()) return descend(*member, dotted, path.substr(name_end));
  if (name_end == path.size() && rule.need == Need::required) refuse_gltf(where + dotted, "is missing");
}

void apply_rule(const json& document, const Rule& rule) {
  const std::uint64_t end = rule.kind == JsonKind::index ? array_size(document, rule.target)
                                                         : std::uint64_t{std::numeric_limits<std::int32_t>::max()};
  std::string where;
  walk(document, rule.path, rule, end, where);
}

void check_version(const json& document) {
  const auto asset = document.find("asset");
  if (asset == document.end() || !asset->is_object() || !asset->contains("version") ||
      !(*asset)["version"].is_string()) {
    refuse_gltf("asset.version", "is missing, so this is not a glTF 2.0 file");
  }
  const auto version = (*asset)["version"].get<std::string>();
  if (!version.starts_with("2.")) {
    refuse_gltf("asset.version", fmt::format("glTF {:.16} is not supported", version), "convert the file to glTF 2.0");
  }
}

void check_required_extensions(const json& document) {
  std::string missing;
  for (const json& extension : document.value("extensionsRequired", json::array())) {
    const auto name = extension.get<std::string>();
    if (reads_gltf_extension(name) || !gltf_layer(name).empty()) continue;
    const std::string_view encoding = meaning_of(name, encodings);
    missing += (missing.empty() ? "" : ", ") + name;
    if (!encoding.empty()) missing += fmt::format(" ({})", encoding);
  }
  if (!missing.empty()) {
    refuse_gltf("extensionsRequired", "requires what Footprint does not support: " + missing.substr(0, 400),
                "export without these extensions");
  }
}

void check_buffer_views(const json& document) {
  const json views = document.value("bufferViews", json::array());
  for (std::size_t i = 0; i < views.size(); ++i) {
    const auto offset = views[i].value("byteOffset", std::uint64_t{0});
    const auto length = views[i]["byteLength"].get<std::uint64_t>();
    const auto available =
        document["buffers"][views[i]["buffer"].get<std::size_t>()]["byteLength"].get<std::uint64_t>();
    const std::string where = fmt::format("bufferViews[{}]", i);
    if (length == 0) refuse_gltf(where + ".byteLength", "must be at least 1");
    if (offset + length > available) {
      refuse_gltf(where,
                  fmt::format("bytes {} to {} are not within the buffer's {}", offset, offset + length, available));
    }
  }
}

// tinygltf names neither the buffer nor what is wrong with it, but the whole URI.
void check_embedded_buffers(const json& document) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const json buffers = document.value("buffers", json::array());
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    const auto uri = buffers[i].value("uri", std::string{});
    if (!uri.starts_with("data:")) continue;
    const std::string_view text = std::string_view(uri).substr(uri.find(',') + 1);
    const std::size_t bytes = std::min(text.find_first_not_of(digits), text.size()) * 6 / 8;
    const auto length = buffers[i]["byteLength"].get<std::uint64_t>();
    if (bytes == length) continue;
    refuse_gltf(fmt::format("buffers[{}]", i),
                fmt::format("its data URI has {} bytes, byteLength is {}", bytes, length));
  }
}

void check_uris(const json& document, const std::string& array) {
  const json items = document.value(array, json::array());
  for (std::size_t i = 0; i < items.size(); ++i) {
    const auto uri = items[i].value("uri", std::string{});
    const std::string where = fmt::format("{}[{}].uri", array, i);
    if (uri.starts_with("data:")) {
      if (!tinygltf::IsDataURI(uri)) {
        refuse_gltf(where, fmt::format("this kind of data URI cannot be read: `{:.40}`", uri),
                    "use base64 with application/octet-stream, image/png or image/jpeg");
      }
    } else if (uri.find("://") != std::string::npos) {
      refuse_gltf(where, fmt::format("`{:.120}` is not fetched from the network", uri),
                  "put the file beside the glTF and name it by a relative path");
    }
  }
}

}  // namespace

json parse_gltf_json(std::string_view text) {
  const int deepest = 64;  // tinygltf recurses into extras and extensions
  const auto limit_depth = [=](int depth, json::parse_event_t, json&) {
    if (depth > deepest) refuse_gltf({}, fmt::format("the JSON is nested more than {} deep", deepest));
    return true;
  };
  try {
    return json::parse(text, limit_depth);
  } catch (const json::exception& error) {
    const std::string_view reason = error.what();
    refuse_gltf(
        {}, fmt::format("not valid JSON: {:.300}", reason.substr(reason.find("] ") + 2)));  // without its own number
  }
}

void check_gltf_json(const json& document) {
  if (!document.is_object()) refuse_gltf({}, "the JSON is not an object, so this is not a glTF file");
  check_version(document);
  for (const Rule& rule : rules) apply_rule(document, rule);
  for (const std::string_view texture : texture_paths) {
    for (Rule rule : texture_rules) {
      const std::string path = std::string{texture} + std::string{rule.path};
      rule.path = path;
      apply_rule(document, rule);
    }
  }
  check_required_extensions(document);
  check_buffer_views(document);
  check_uris(document, "buffers");
  check_uris(document, "images");
  check_embedded_buffers(document);
}

bool reads_gltf_extension(std::string_view name) { return std::ranges::find(supported, name) != supported.end(); }

std::string_view gltf_layer(std::string_view name) { return meaning_of(name, layers); }

}  // namespace footprint
