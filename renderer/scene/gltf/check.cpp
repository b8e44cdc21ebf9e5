// A table of rules gives the type of each member; a walker applies them.
#include "renderer/scene/gltf/document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>

#include "renderer/core/names.hpp"

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

/// The type of the members that `path` names: "[]" is every element, "*" every member, "{a,b}" both a and b. What the
/// path leads through must be arrays and objects.
struct Rule {
  std::string_view path;
  JsonKind kind;
  Need need = Need::optional;
  std::string_view target{};
  std::size_t count = 0;
};

/// Rules whose paths start with `path`.
struct RuleGroup {
  std::string_view path;
  std::vector<Rule> rules;
};

// The first group is the core of glTF 2.0; then a group per extension, and one for references to textures.
const std::vector<RuleGroup>& rule_groups() {
  using enum JsonKind;
  using enum Need;
  static const std::vector<RuleGroup> groups{
      {"",
       {{"{extensionsUsed,extensionsRequired}[]", string},
        {"{scenes,nodes,meshes,images,materials,cameras,animations}[].name", string},
        {"scene", index, optional, "scenes"},
        {"{scenes[].nodes,nodes[].children}[]", index, optional, "nodes"},
        {"nodes[].mesh", index, optional, "meshes"},
        {"nodes[].camera", index, optional, "cameras"},
        {"nodes[].skin", index, optional, "skins"},
        {"nodes[].matrix", numbers, optional, "", 16},
        {"nodes[].{translation,scale}", numbers, optional, "", 3},
        {"nodes[].rotation", numbers, optional, "", 4},
        {"{nodes,meshes}[].weights[]", number},
        {"skins[].joints", array, required},
        {"skins[].joints[]", index, optional, "nodes"},
        {"skins[].inverseBindMatrices", index, optional, "accessors"},
        {"animations[].{channels,samplers}", array, required},
        {"animations[].channels[].sampler", size, required},
        {"animations[].channels[].target", object, required},
        {"animations[].channels[].target.node", index, optional, "nodes"},
        {"animations[].channels[].target.path", string, required},
        {"animations[].samplers[].{input,output}", index, required, "accessors"},
        {"animations[].samplers[].interpolation", string},
        {"meshes[].primitives", array, required},
        {"meshes[].primitives[].attributes", object, required},
        {"meshes[].primitives[].{attributes.*,indices}", index, optional, "accessors"},
        {"meshes[].primitives[].targets[].*", index, optional, "accessors"},
        {"meshes[].primitives[].material", index, optional, "materials"},
        {"meshes[].primitives[].mode", size},
        {"accessors[].bufferView", index, optional, "bufferViews"},
        {"accessors[].{byteOffset,sparse.indices.byteOffset,sparse.values.byteOffset}", size},
        {"accessors[].{componentType,count,sparse.count,sparse.indices.componentType}", size, required},
        {"accessors[].normalized", boolean},
        {"accessors[].type", string, required},
        {"accessors[].sparse.{indices,values}", object, required},
        {"accessors[].sparse.{indices,values}.bufferView", index, required, "bufferViews"},
        {"bufferViews[].buffer", index, required, "buffers"},
        {"bufferViews[].{byteOffset,byteStride}", size},
        {"{bufferViews,buffers}[].byteLength", size, required},
        {"{buffers,images}[].uri", string},
        {"images[].bufferView", index, optional, "bufferViews"},
        {"textures[].source", index, optional, "images"},
        {"textures[].sampler", index, optional, "samplers"},
        {"samplers[].{wrapS,wrapT}", size},
        {"materials[].doubleSided", boolean},
        {"materials[].alphaMode", string},
        {"materials[].{alphaCutoff,normalTexture.scale,occlusionTexture.strength}", number},
        {"materials[].emissiveFactor", numbers, optional, "", 3},
        {"materials[].pbrMetallicRoughness.baseColorFactor", numbers, optional, "", 4},
        {"materials[].pbrMetallicRoughness.{metallicFactor,roughnessFactor}", number},
        {"materials[].extensions.*", object},
        {"cameras[].type", string, required},
        {"cameras[].{perspective,orthographic}.{aspectRatio,xmag,yfov,ymag,zfar,znear}", number}}},
      {"nodes[].extensions.KHR_lights_punctual",
       {{".light", index, required, "extensions.KHR_lights_punctual.lights"}}},
      {"nodes[].extensions.KHR_node_visibility", {{".visible", boolean}}},
      {"extensions.KHR_lights_punctual",
       {{".lights", array, required},
        {".lights[].type", string, required},
        {".lights[].color", numbers, optional, "", 3},
        {".lights[].{intensity,range}", number},
        {".lights[].spot.{innerConeAngle,outerConeAngle}", number}}},
      {"extensions.KHR_materials_variants", {{".variants", array, required}, {".variants[].name", string}}},
      {"meshes[].primitives[].extensions.KHR_materials_variants",
       {{".mappings", array, required},
        {".mappings[].material", index, required, "materials"},
        {".mappings[].variants", array, required},
        {".mappings[].variants[]", index, optional, "extensions.KHR_materials_variants.variants"}}},
      {"meshes[].primitives[].extensions.KHR_draco_mesh_compression",
       {{".bufferView", index, required, "bufferViews"}, {".attributes", object, required}, {".attributes.*", size}}},
      {"bufferViews[].extensions.EXT_meshopt_compression",
       {{".buffer", index, required, "buffers"},
        {".byteOffset", size},
        {".{byteLength,byteStride,count}", size, required},
        {".mode", string, required},
        {".filter", string}}},
      {"textures[].extensions.EXT_texture_webp", {{".source", index, optional, "images"}}},
      {"materials[].extensions.KHR_materials_emissive_strength", {{".emissiveStrength", number}}},
      {"materials[].extensions.KHR_materials_ior", {{".ior", number}}},
      {"materials[].extensions.KHR_materials_clearcoat",
       {{".{clearcoatFactor,clearcoatRoughnessFactor,clearcoatNormalTexture.scale}", number}}},
      {"materials[].extensions.KHR_materials_anisotropy", {{".{anisotropyStrength,anisotropyRotation}", number}}},
      {"materials[].extensions.KHR_materials_pbrSpecularGlossiness",
       {{".diffuseFactor", numbers, optional, "", 4},
        {".specularFactor", numbers, optional, "", 3},
        {".glossinessFactor", number}}},
      {"materials[].{pbrMetallicRoughness.baseColorTexture,pbrMetallicRoughness.metallicRoughnessTexture,normalTexture,"
       "occlusionTexture,emissiveTexture,extensions.KHR_materials_clearcoat.clearcoatTexture,"
       "extensions.KHR_materials_clearcoat.clearcoatRoughnessTexture,"
       "extensions.KHR_materials_clearcoat.clearcoatNormalTexture,"
       "extensions.KHR_materials_anisotropy.anisotropyTexture,"
       "extensions.KHR_materials_pbrSpecularGlossiness.diffuseTexture,"
       "extensions.KHR_materials_pbrSpecularGlossiness.specularGlossinessTexture}",
       {{".index", index, required, "textures"},
        {".texCoord", size},
        {".extensions.KHR_texture_transform.{offset,scale}", numbers, optional, "", 2},
        {".extensions.KHR_texture_transform.rotation", number},
        {".extensions.KHR_texture_transform.texCoord", size}}}};
  return groups;
}

enum class Support {
  read,
  layer,     ///< adds `meaning` to a surface that is whole without it
  encoding,  ///< stores a file as `meaning`, which is not read
};

struct Extension {
  std::string_view name;
  Support support = Support::read;
  std::string_view meaning{};
};

constexpr auto known_extensions = std::to_array<Extension>({
    {"EXT_meshopt_compression"},
    {"EXT_texture_webp"},
    {"KHR_draco_mesh_compression"},
    {"KHR_lights_punctual"},
    {"KHR_materials_anisotropy"},
    {"KHR_materials_clearcoat"},
    {"KHR_materials_emissive_strength"},
    {"KHR_materials_ior"},
    {"KHR_materials_pbrSpecularGlossiness"},
    {"KHR_materials_unlit"},
    {"KHR_materials_variants"},
    {"KHR_mesh_quantization"},
    {"KHR_node_visibility"},
    {"KHR_texture_transform"},
    {"KHR_materials_diffuse_transmission", Support::layer, "diffuse transmission"},
    {"KHR_materials_dispersion", Support::layer, "dispersion"},
    {"KHR_materials_iridescence", Support::layer, "iridescence"},
    {"KHR_materials_sheen", Support::layer, "sheen"},
    {"KHR_materials_specular", Support::layer, "the strength and colour of the specular term"},
    {"KHR_materials_transmission", Support::layer, "transmission"},
    {"KHR_materials_volume", Support::layer, "the volume under the surface"},
    {"KHR_texture_basisu", Support::encoding, "KTX2 textures (Basis Universal)"},
});

const Extension* find_extension(std::string_view name, Support support) {
  const auto* const found = std::ranges::find(known_extensions, name, &Extension::name);
  return found != known_extensions.end() && found->support == support ? found : nullptr;
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

// A kind that a single value has or has not.
struct SimpleKind {
  JsonKind kind;
  bool (json::*is_of)() const noexcept;
  const char* fault;
};

constexpr std::array<SimpleKind, 5> simple_kinds{{{JsonKind::object, &json::is_object, "must be an object"},
                                                  {JsonKind::array, &json::is_array, "must be an array"},
                                                  {JsonKind::string, &json::is_string, "must be a string"},
                                                  {JsonKind::boolean, &json::is_boolean, "must be true or false"},
                                                  {JsonKind::number, &json::is_number, "must be a number"}}};

void check_value(const json& value, const Rule& rule, const std::string& where, std::uint64_t end) {
  if (rule.kind == JsonKind::numbers) return check_numbers(value, rule.count, where);
  if (rule.kind == JsonKind::size || rule.kind == JsonKind::index) return check_whole(value, end, where, rule.target);
  const SimpleKind& kind = *std::ranges::find(simple_kinds, rule.kind, &SimpleKind::kind);
  if (!(value.*kind.is_of)()) refuse_gltf(where, kind.fault);
}

/// Applies `rule` to the members that `path`, the rest of its path, names below `value`. `where` is a stack of names,
/// joined only for an error, because large files have many places and few errors.
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
      // Extensions and extras are not members of the parent's own kind.
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

/// Applies `rule` to each path that `path` expands to.
void apply_rule(const json& document, const Rule& rule, const std::string& path) {
  if (const std::size_t open = path.find('{'); open != std::string::npos) {
    const std::size_t close = path.find('}', open);
    for (std::size_t at = open + 1, end = 0; at <= close; at = end + 1) {
      end = std::min(path.find(',', at), close);
      apply_rule(document, rule, path.substr(0, open) + path.substr(at, end - at) + path.substr(close + 1));
    }
    return;
  }
  const std::uint64_t end = rule.kind == JsonKind::index ? array_size(document, rule.target)
                                                         : std::uint64_t{std::numeric_limits<std::int32_t>::max()};
  std::string where;
  walk(document, path, rule, end, where);
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
    missing += (missing.empty() ? "" : ", ") + name;
    if (const Extension* encoding = find_extension(name, Support::encoding))
      missing += fmt::format(" ({})", encoding->meaning);
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

// The kinds that tinygltf knows.
void check_accessors(const json& document) {
  const json accessors = document.value("accessors", json::array());
  for (std::size_t i = 0; i < accessors.size(); ++i) {
    const std::string where = fmt::format("accessors[{}]", i), type = accessors[i]["type"];
    const auto component = accessors[i]["componentType"].get<int>();
    constexpr std::array<std::string_view, 7> types{"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"};
    if (std::ranges::find(types, type) == types.end())
      refuse_gltf(where + ".type", fmt::format("`{:.40}` is not a type of glTF 2.0", type));
    if (component < TINYGLTF_COMPONENT_TYPE_BYTE || component > TINYGLTF_COMPONENT_TYPE_FLOAT)
      refuse_gltf(where + ".componentType", fmt::format("{} is not a component type of glTF 2.0", component));
  }
}

// The scheme of a URI in lower case; empty for a path, also one that starts with a drive such as "C:".
std::string scheme_of(const std::string& uri) {
  const std::size_t end = uri.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789+.-");
  return end == std::string::npos || end < 2 || uri[end] != ':' ? "" : lower_case(uri.substr(0, end));
}

void check_uris(const json& document, const std::string& array) {
  const json items = document.value(array, json::array());
  for (std::size_t i = 0; i < items.size(); ++i) {
    const auto uri = items[i].value("uri", std::string{});
    const std::string where = fmt::format("{}[{}].uri", array, i), scheme = scheme_of(uri);
    constexpr const char* beside = "put the file beside the glTF and name it by a relative path";
    if (scheme == "data") {
      if (!lower_case(uri.substr(0, uri.find(','))).ends_with(";base64"))
        refuse_gltf(where, fmt::format("this kind of data URI cannot be read: `{:.40}`", uri), "encode it in base64");
    } else if (scheme == "file") {
      const std::string rest = uri.substr(5);
      if (rest.starts_with("//") && !rest.starts_with("///") && !rest.starts_with("//localhost/"))
        refuse_gltf(where, fmt::format("`{:.120}` is a file of another machine", uri), beside);
    } else if (uri.find("://") != std::string::npos || uri.starts_with("//")) {
      refuse_gltf(where, fmt::format("`{:.120}` is not fetched from the network", uri), beside);
    } else if (!scheme.empty() && scheme.find('.') == std::string::npos) {
      refuse_gltf(where, fmt::format("`{:.120}` is a URI of the scheme `{}`, which is not read", uri, scheme), beside);
    }
  }
}

}  // namespace

json parse_gltf_json(std::string_view text) {
  const int deepest = 64;
  const auto limit_depth = [=](int depth, json::parse_event_t, json&) {
    if (depth > deepest) refuse_gltf({}, fmt::format("the JSON is nested more than {} deep", deepest));
    return true;
  };
  try {
    json document = json::parse(text, limit_depth);
    normalize_gltf(document);
    return document;
  } catch (const json::exception& error) {
    const std::string_view reason = error.what();
    refuse_gltf(
        {}, fmt::format("not valid JSON: {:.300}", reason.substr(reason.find("] ") + 2)));  // without its own number
  }
}

void check_gltf_json(const json& document) {
  if (!document.is_object()) refuse_gltf({}, "the JSON is not an object, so this is not a glTF file");
  check_version(document);
  for (const RuleGroup& group : rule_groups()) {
    for (const Rule& rule : group.rules) apply_rule(document, rule, fmt::format("{}{}", group.path, rule.path));
  }
  check_required_extensions(document);
  check_buffer_views(document);
  check_accessors(document);
  check_uris(document, "buffers");
  check_uris(document, "images");
}

bool reads_gltf_extension(std::string_view name) { return find_extension(name, Support::read) != nullptr; }

std::string_view gltf_layer(std::string_view name) {
  const Extension* const layer = find_extension(name, Support::layer);
  return layer != nullptr ? layer->meaning : std::string_view{};
}

}  // namespace footprint
