// Every member is checked where it is read; an error names it. Names become GLSL, and paths are opened.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>

#include "renderer/baked_files/manifest.hpp"
#include "renderer/core/bytes.hpp"
#include "renderer/core/error.hpp"
#include "renderer/image/mipmap.hpp"
#include "renderer/scene/gltf/document.hpp"

namespace footprint {
namespace {

using JsonValue = nlohmann::json;

constexpr std::uint64_t largest_manifest = std::uint64_t{256} << 20U;
constexpr const char* bake_again = "repair the manifest, or bake again";
constexpr int largest_map = 1 << 20, most_layers = 1 << 16, largest_set = 1 << 16;

[[noreturn]] void refuse_member(const std::string& place, const std::string& message) {
  throw Error(ErrorKind::usage, place, message, bake_again);
}

const JsonValue& member(const JsonValue& object, const char* name) {
  if (!object.is_object() || !object.contains(name)) refuse_member(name, "is missing");
  return object[name];
}

// Runs `read` on a member; errors name it.
template <class Reader>
auto at_member(const JsonValue& object, const char* name, Reader read) {
  const JsonValue& value = member(object, name);
  try {
    return read(value);
  } catch (const Error& error) {
    throw error.within(name);
  }
}

const JsonValue& list_of(const JsonValue& value, std::optional<std::size_t> count = {}) {
  if (!value.is_array()) refuse_member({}, "is not a list");
  if (count && value.size() != *count) refuse_member({}, fmt::format("has {} items, not {}", value.size(), *count));
  return value;
}

const JsonValue& object_of(const JsonValue& value) {
  if (!value.is_object()) refuse_member({}, "is not an object");
  return value;
}

// Runs `read` on every item of a member; errors name it as "textures[1]".
template <class Reader>
void at_each(const JsonValue& object, const char* name, Reader read) {
  const JsonValue& items = member(object, name);
  if (!items.is_array()) refuse_member(name, "is not a list");
  for (std::size_t i = 0; i < items.size(); ++i) {
    try {
      read(items[i]);
    } catch (const Error& error) {
      throw error.within(fmt::format("{}[{}]", name, i));
    }
  }
}

std::string text_of(const JsonValue& value) {
  if (!value.is_string()) refuse_member({}, "is not a text");
  return value.get<std::string>();
}

float number_of(const JsonValue& value) {
  if (!value.is_number()) refuse_member({}, "is not a number");
  const auto number = value.get<double>();
  if (!(std::abs(number) <= std::numeric_limits<float>::max())) refuse_member({}, "does not fit a 32-bit float");
  return static_cast<float>(number);
}

int whole_of(const JsonValue& value, int least, int most) {
  if (!value.is_number_integer() || value < least || value > most)
    refuse_member({}, fmt::format("is not a whole number from {} to {}", least, most));
  return value.get<int>();
}

std::vector<std::string> texts_of(const JsonValue& value) {
  std::vector<std::string> texts;
  for (const JsonValue& text : list_of(value)) texts.push_back(text_of(text));
  return texts;
}

std::vector<float> numbers_of(const JsonValue& value, std::optional<std::size_t> count = {}) {
  std::vector<float> list;
  for (const JsonValue& number : list_of(value, count)) list.push_back(number_of(number));
  return list;
}

glm::vec2 pair_of(const JsonValue& value) {
  const std::vector<float> two = numbers_of(value, 2);
  return {two[0], two[1]};
}

// A name that becomes a part of GLSL.
std::string identifier_of(const std::string& text) {
  constexpr std::size_t longest = 64;
  const bool is_name =
      !text.empty() && text.size() <= longest && text.front() != '_' &&
      text.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789") == std::string::npos &&
      std::string_view("0123456789").find(text.front()) == std::string_view::npos;
  if (!is_name) refuse_member({}, fmt::format("`{:.80}` is not a name of a variable in GLSL", text));
  return text;
}

// A path that stays below the manifest's folder.
std::string path_of(const JsonValue& value) {
  const std::string text = text_of(value);
  const std::filesystem::path path = text;
  if (path.is_absolute() || !path.has_filename() || std::ranges::find(path, "..") != path.end())
    refuse_member({}, fmt::format("`{:.200}` is not a file below the manifest's folder", text));
  return text;
}

template <class Words>
auto word_of(const Words& words, const JsonValue& value) {
  return word_value(words, text_of(value), "word", "");
}

TextureCoordinates parse_coordinates(const JsonValue& json) {
  TextureCoordinates coordinates;
  const int set = at_member(json, "set", [](const JsonValue& value) { return whole_of(value, 0, largest_set); });
  coordinates.set = json.contains("vertex_set")
                        ? at_member(json, "vertex_set", [](const JsonValue& value) { return whole_of(value, 0, 1); })
                        : set;
  if (coordinates.set > 1) refuse_member("vertex_set", "is missing, and `set` is above 1");
  if (set != coordinates.set) coordinates.texcoord = set;
  coordinates.transform = at_member(json, "transform", [](const JsonValue& value) {
    const JsonValue& columns = list_of(value, 3);
    return glm::mat3x2(pair_of(columns[0]), pair_of(columns[1]), pair_of(columns[2]));
  });
  coordinates.wrap = at_member(json, "wrap", [](const JsonValue& both) {
    return std::array<Wrap, 2>{word_of(manifest_wraps, list_of(both, 2)[0]), word_of(manifest_wraps, both[1])};
  });
  return coordinates;
}

// `filter` says `linear` of two kinds.
TextureFilter parse_filter(const JsonValue& json) {
  const auto lookup = [](const JsonValue& value) { return word_of(manifest_lookups, value); };
  if (json.contains("lookup")) return at_member(json, "lookup", lookup);
  const TextureFilter filter = at_member(json, "filter", lookup);
  if (filter == TextureFilter::linear)
    refuse_member("lookup", "is missing, and `linear` does not say whether the map is a table");
  return filter;
}

std::vector<TextureLevel> parse_levels(const JsonValue& sizes) {
  std::vector<TextureLevel> levels;
  for (const JsonValue& size : list_of(sizes))
    levels.push_back({.width = whole_of(list_of(size, 2)[0], 1, largest_map),
                      .height = whole_of(size[1], 1, largest_map),
                      .bytes = {}});
  if (levels.empty()) refuse_member({}, "is empty");
  const TextureLevel& finest = levels.front();
  const auto whole = static_cast<std::size_t>(mip_level_count(finest.width, finest.height));
  if (levels.size() != 1 && levels.size() != whole)
    refuse_member(
        {}, fmt::format("has {} items; {}x{} has 1 or {} levels", levels.size(), finest.width, finest.height, whole));
  for (std::size_t i = 1; i < levels.size(); ++i) {
    const int width = std::max(finest.width >> i, 1), height = std::max(finest.height >> i, 1);
    if (levels[i].width != width || levels[i].height != height)
      refuse_member({}, fmt::format("level {} is {}x{}, not {}x{}, half of the level before", i, levels[i].width,
                                    levels[i].height, width, height));
  }
  return levels;
}

// With a storage of blocks only the count of its own channels exists.
void require_channels(Storage storage, int channels) {
  const int only = storage == Storage::bc1 ? 3 : storage == Storage::bc5 ? 2 : 1;
  if (is_block(storage) && channels != only)
    refuse_member("channels", fmt::format("is {}, and {} has {}", channels, storage_name(storage), only));
}

PrefilteredTexture parse_texture(const JsonValue& json) {
  PrefilteredTexture texture;
  texture.name = at_member(json, "name", [](const JsonValue& value) { return identifier_of(text_of(value)); });
  texture.storage = parse_storage(at_member(json, "storage", text_of));
  texture.channels = at_member(json, "channels", [](const JsonValue& value) { return whole_of(value, 1, 4); });
  require_channels(texture.storage, texture.channels);
  texture.layers = at_member(json, "layers", [](const JsonValue& value) { return whole_of(value, 0, most_layers); });
  texture.filter = parse_filter(json);
  texture.coordinates = at_member(json, "coordinates", parse_coordinates);
  texture.levels = at_member(json, "levels", parse_levels);
  return texture;
}

using Uniforms = std::map<std::string, std::vector<float>>;

Uniforms parse_uniforms(const JsonValue& json) {
  Uniforms uniforms;
  for (const auto& [name, value] : object_of(json).items()) {
    try {
      uniforms[name] = value.is_number() ? std::vector{number_of(value)} : numbers_of(value);
    } catch (const Error& error) {
      throw error.within(fmt::format("{:.80}", name));
    }
  }
  return uniforms;
}

std::vector<glm::vec2> pairs_of(const JsonValue& value) {
  std::vector<glm::vec2> pairs;
  for (const JsonValue& pair : list_of(value)) pairs.push_back(pair_of(pair));
  return pairs;
}

ManifestMaterial parse_material(const JsonValue& json) {
  ManifestMaterial material;
  material.name = at_member(json, "name", text_of);
  material.uniforms = at_member(json, "uniforms", parse_uniforms);
  material.maps.notes = at_member(json, json.contains("method_notes") ? "method_notes" : "notes", texts_of);
  if (json.contains("surface_coordinates"))
    material.maps.surface_coordinates = at_member(json, "surface_coordinates", pairs_of);
  at_each(json, "textures", [&](const JsonValue& texture) {
    material.maps.textures.push_back(parse_texture(object_of(texture)));
    material.ktx2.push_back(at_member(texture, "ktx2", path_of));
  });
  return material;
}

std::map<std::string, std::string> parse_words(const JsonValue& json) {
  std::map<std::string, std::string> words;
  for (const auto& [name, value] : object_of(json).items()) {
    if (!value.is_primitive()) refuse_member(fmt::format("{:.80}", name), "is neither a text nor a number");
    words[name] = manifest_word(value);
  }
  return words;
}

// An item of the vector `name`, of which `uniforms` have as many items as it has places.
glm::vec2 item_of(const Uniforms& uniforms, const std::string& name, std::size_t index) {
  const auto found = uniforms.find(fmt::format("{}[{}]", name, index));
  if (found == uniforms.end() || found->second.size() != 2)
    refuse_member("uniforms", fmt::format("`{}` is none of the material, neither a number nor a list of pairs", name));
  return {found->second[0], found->second[1]};
}

BakeManifest parse_manifest(const JsonValue& json) {
  if (at_member(json, "schema", text_of) != manifest_schema)
    refuse_member("schema", fmt::format("is not `{}`", manifest_schema));
  BakeManifest manifest;
  manifest.method = at_member(json, "method", text_of);
  manifest.module = at_member(json, "module", text_of);
  if (json.contains("method_file")) manifest.method_file = at_member(json, "method_file", text_of);
  manifest.options = at_member(json, "options", parse_words);
  manifest.brdf = at_member(json, "brdf", parse_words);
  manifest.effects = at_member(json, "effects", texts_of);
  at_each(json, "materials",
          [&](const JsonValue& material) { manifest.materials.push_back(parse_material(object_of(material))); });
  return manifest;
}

}  // namespace

BakeManifest read_manifest(const std::filesystem::path& file) {
  const std::vector<std::uint8_t> bytes = read_file_bytes(file, largest_manifest);
  try {
    return parse_manifest(object_of(parse_gltf_json({reinterpret_cast<const char*>(bytes.data()), bytes.size()})));
  } catch (const Error& error) {
    throw error.within(file.string());
  }
}

void take_uniforms(const ManifestMaterial& from, const std::vector<std::string>& of_material, Prefiltered& into) {
  Uniforms own = from.uniforms;
  for (const std::string& name : of_material) {
    if (own.erase(name) == 0) refuse_member("uniforms", fmt::format("lacks `{}`, which the material has", name));
  }
  for (const auto& [name, values] : own) {
    const std::string base = identifier_of(name.substr(0, name.find('[')));
    if (base == name && values.size() == 1) {
      into.scalars[name] = values.front();
    } else {
      into.vectors[base].emplace_back();  // filled below, because the names are in the order of their letters
    }
  }
  for (auto& [name, values] : into.vectors) {
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = item_of(own, name, i);
  }
}

}  // namespace footprint
