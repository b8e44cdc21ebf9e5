// Compares the manifest with the run first, then opens the files.
#include "renderer/baked_files/bake_folder.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>
#include <vector>

#include "renderer/baked_files/baked_files.hpp"
#include "renderer/core/bytes.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/process.hpp"
#include "renderer/scene/geometry.hpp"

namespace footprint {
namespace {

namespace fs = std::filesystem;
using Words = std::map<std::string, std::string>;

constexpr const char* manifest_name = "manifest.json";
constexpr const char* bake_this_scene = "bake this scene with `footprint bake`, or name the folder of its own bake";

// A text as a manifest has it, where UTF-8 that is not valid is replaced.
std::string written_text(const std::string& text) {
  const std::string json = nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  return nlohmann::json::parse(json).get<std::string>();
}

// Differences of values by name: "option storage is fp16 there and fp32 here". An option of one side alone has the
// value of `defaults`, because another version of the program may not have it.
std::string difference_of(const std::string& what, const Words& there, const Words& here, const Words& defaults = {}) {
  const auto value_in = [&](const Words& words, const std::string& name) {
    if (const auto found = words.find(name); found != words.end()) return found->second;
    const auto fallback = defaults.find(name);
    return fallback == defaults.end() ? std::string("missing") : fallback->second;
  };
  Words all = here;
  all.insert(there.begin(), there.end());
  std::vector<std::string> differences;
  for (const auto& [name, ignored] : all) {
    const std::string old = value_in(there, name), now = value_in(here, name);
    if (old != now) differences.push_back(fmt::format("{} {} is {} there and {} here", what, name, old, now));
  }
  return fmt::format("{}", fmt::join(differences, ", "));
}

// Effects of one side alone.
std::string difference_of(const std::vector<std::string>& there, const std::vector<std::string>& here) {
  const auto beyond = [](const std::vector<std::string>& all, const std::vector<std::string>& others) {
    std::vector<std::string> names;
    std::ranges::copy_if(all, std::back_inserter(names),
                         [&](const std::string& name) { return std::ranges::find(others, name) == others.end(); });
    return names;
  };
  std::vector<std::string> parts;
  if (const auto names = beyond(there, here); !names.empty())
    parts.push_back(fmt::format("the maps are for {} too, which this run leaves out", fmt::join(names, ", ")));
  if (const auto names = beyond(here, there); !names.empty())
    parts.push_back(fmt::format("this run has {}, which the maps leave out", fmt::join(names, ", ")));
  return fmt::format("{}", fmt::join(parts, ", and "));
}

// The declarations of a material's maps in a program: names and kinds. All materials of a scene share one program.
std::vector<std::string> textures_declared(const Prefiltered& maps) {
  std::vector<std::string> names;
  for (const PrefilteredTexture& texture : maps.textures)
    names.push_back(texture.name + (texture.layers > 0 ? " (an array)" : ""));
  return names;
}

std::vector<std::string> values_declared(const Prefiltered& maps) {
  std::vector<std::string> names;
  for (const auto& [name, value] : maps.scalars) names.push_back(name);
  for (const auto& [name, values] : maps.vectors) names.push_back(fmt::format("{}[{}]", name, values.size()));
  if (maps.surface_coordinates) names.emplace_back("surface_coordinates");
  return names;
}

bool has_triangles(const Scene& scene, std::size_t material) {
  return std::ranges::any_of(scene.meshes, [&](const Mesh& mesh) {
    return static_cast<std::size_t>(mesh.material) == material && !mesh.indices.empty();
  });
}

void require_same(const std::string& place, const char* what, const std::vector<std::string>& found,
                  const std::vector<std::string>& expected) {
  if (found == expected) return;
  throw Error(ErrorKind::usage, place,
              fmt::format("its {} are {}; those of the first material are {}", what, fmt::join(found, ", "),
                          fmt::join(expected, ", ")),
              "all materials must have the same: repair the manifest, or bake again");
}

void require_surface(const Prefiltered& maps, const Scene& scene, std::size_t material) {
  if (!maps.surface_coordinates) return;
  const std::size_t expected = collect_triangles(scene, material).vertices.size();
  if (maps.surface_coordinates->size() == expected) return;
  throw Error(ErrorKind::usage, "surface_coordinates",
              fmt::format("has {} items, and the model {} vertices of this material", maps.surface_coordinates->size(),
                          expected),
              bake_this_scene);
}

ByteSource open_file(const fs::path& file) {
  if (auto source = ByteSource::of_file(file)) return *std::move(source);
  throw Error(ErrorKind::usage, file.string(), "is missing, or cannot be read",
              "copy the whole folder of the bake, or bake again");
}

// Reads a file by `work`; errors name it.
template <class Work>
void at_file(const fs::path& file, Work work) {
  const ByteSource source = open_file(file);
  try {
    work(source);
  } catch (const Error& error) {
    throw error.within(file.string());
  }
}

// Adds a file piece by piece.
void add_file(ContentHash& hash, const fs::path& file) {
  const ByteSource source = open_file(file);
  std::vector<std::uint8_t> piece(std::size_t{1} << 20U);
  for (std::uint64_t at = 0; at < source.size(); at += piece.size()) {
    const auto part = std::span(piece).first(std::min<std::uint64_t>(piece.size(), source.size() - at));
    if (!source.read(at, part)) throw Error(ErrorKind::machine, file.string(), "cannot be read", "check the disk");
    hash.add(std::as_bytes(part));
  }
}

}  // namespace

BakeFolder::BakeFolder(fs::path folder)
    : folder_(std::move(folder)), manifest_(read_manifest(folder_ / manifest_name)) {}

std::string BakeFolder::difference(const Method& method, const Options& options) const {
  if (manifest_.module != method.info.name + ".glsl")
    return fmt::format("the maps are of `{}`, not of {}", manifest_.method, method.info.name);
  if (manifest_.method_file && *manifest_.method_file != method.file_content)
    return fmt::format("the file of {} has changed since the maps were baked", method.info.name);
  const Options defaults(method.info.options, {}, "method " + method.info.name);
  return difference_of("option", manifest_.options, words_of(options), words_of(defaults));
}

void BakeFolder::require_run(const BakedMethod& wanted, const Scene& scene, const EffectSet& honoured) const {
  const auto require_none = [&](const std::string& different, const char* hint) {
    if (!different.empty()) throw Error(ErrorKind::usage, (folder_ / manifest_name).string(), different, hint);
  };
  require_none(difference(*wanted.method, wanted.options), "name the folder of that method with these options");
  std::vector<std::string> names, own;
  for (const ManifestMaterial& material : manifest_.materials) names.push_back(material.name);
  for (const Material& material : scene.materials) own.push_back(written_text(material.name));
  if (names != own)
    require_none(fmt::format("the maps are for {} materials ({}), and the scene has {} ({})", names.size(),
                             fmt::join(names, ", "), own.size(), fmt::join(own, ", ")),
                 bake_this_scene);
  require_none(difference_of("base BRDF:", manifest_.brdf, words_of(scene.materials.front().brdf)), bake_this_scene);
  require_none(difference_of(manifest_.effects, effect_names(honoured)),
               "`footprint bake` takes all effects of its scene: leave out the options that change them, or bake the "
               "scene as it is rendered");
}

Prefiltered BakeFolder::form(const Scene& scene, std::size_t index, const EffectSet& honoured) const {
  const ManifestMaterial& material = manifest_.materials.at(index);
  Prefiltered maps = material.maps;
  try {
    take_uniforms(material, material_uniform_names(scene.materials[index], honoured), maps);
    require_surface(maps, scene, index);
  } catch (const Error& error) {
    throw error.within(fmt::format("{}, material {}", (folder_ / manifest_name).string(), material.name));
  }
  return maps;
}

void BakeFolder::require_materials(const Scene& scene, const EffectSet& honoured) const {
  const Prefiltered first = form(scene, 0, honoured);
  for (std::size_t i = 0; i < manifest_.materials.size(); ++i) {
    const Prefiltered maps = form(scene, i, honoured);
    const std::string place =
        fmt::format("{}, material {}", (folder_ / manifest_name).string(), scene.materials[i].name);
    require_same(place, "values", values_declared(maps), values_declared(first));
    if (has_triangles(scene, i)) require_same(place, "maps", textures_declared(maps), textures_declared(first));
  }
}

void BakeFolder::require_fit(const BakedMethod& wanted, const Scene& scene, const EffectSet& effects) const {
  const EffectSet honoured = effects & wanted.method->info.honours;
  require_run(wanted, scene, honoured);
  require_materials(scene, honoured);
  for (const ManifestMaterial& material : manifest_.materials) {
    for (std::size_t t = 0; t < material.ktx2.size(); ++t)
      at_file(folder_ / material.ktx2[t],
              [&](const ByteSource& file) { (void)ktx2_offsets(file, material.maps.textures[t]); });
  }
}

Prefiltered BakeFolder::read(const BakedMethod& wanted, const Scene& scene, std::size_t material,
                             const EffectSet& effects) const {
  Prefiltered maps = form(scene, material, effects & wanted.method->info.honours);
  for (std::size_t t = 0; t < maps.textures.size(); ++t) {
    throw_if_interrupted();
    at_file(folder_ / manifest_.materials[material].ktx2[t],
            [&](const ByteSource& file) { read_ktx2(file, maps.textures[t]); });
  }
  return maps;
}

std::string BakeFolder::content() const {
  ContentHash hash;
  add_file(hash, folder_ / manifest_name);
  for (const ManifestMaterial& material : manifest_.materials) {
    for (const std::string& file : material.ktx2) add_file(hash, folder_ / file);
  }
  return hash.hex();
}

}  // namespace footprint
