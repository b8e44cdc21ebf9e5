// The hash of all inputs of a bake, and the file of that name.
#include "renderer/bake/bake_cache.hpp"

#include <fmt/format.h>

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "renderer/core/hash.hpp"
#include "renderer/scene/scene.hpp"

namespace footprint {
// Found by the archives of core/bytes.hpp. Structured bindings make a new member a compile error here.
void fields(auto& archive, TextureLevel& level) {
  auto& [width, height, bytes] = level;
  archive(width, height, bytes);
}

void fields(auto& archive, PrefilteredTexture& texture) {
  auto& [name, storage, channels, layers, filter, coordinates, levels, built] = texture;
  archive(name, storage, channels, layers, filter, coordinates, levels, built);
}

void fields(auto& archive, Prefiltered& prefiltered) {
  auto& [textures, scalars, vectors, notes, surface_coordinates] = prefiltered;
  archive(textures, scalars, vectors, notes, surface_coordinates);
}

namespace {

constexpr std::string_view form = "footprint bake 7";  // another number for another layout

}  // namespace

void write_bytes(const Prefiltered& prefiltered, const ByteSink& sink) {
  ChecksummedWriter out(form, sink);
  out(prefiltered);
  std::move(out).finish();
}

std::optional<Prefiltered> from_bytes(const ByteSource& bytes) {
  std::optional<ChecksummedReader> in = ChecksummedReader::open(bytes, form);
  if (!in) return {};
  Prefiltered prefiltered;
  (*in)(prefiltered);
  if (!in->finished()) return {};
  return prefiltered;
}

std::string BakeCache::key(const std::string& method, const Material& material, const Options& options,
                           const EffectSet& effects) const {
  ContentHash hash;
  add_program(hash);
  for (const auto& [name, value] : options.all()) {
    hash.add(name);
    if (const auto* word = std::get_if<std::string>(&value)) hash.add(*word);
    if (const auto* number = std::get_if<double>(&value)) hash.add(std::as_bytes(std::span(number, 1)));
  }
  hash.add(effects.to_string());
  add_content(hash, material);
  return fmt::format("{}-{}", method, hash.hex());
}

std::optional<Prefiltered> BakeCache::find(const std::string& key) const {
  const std::optional<ByteSource> bytes = files_.find(key);
  return bytes ? from_bytes(*bytes) : std::nullopt;
}

void BakeCache::store(const std::string& key, const Prefiltered& prefiltered) const {
  files_.store(key, byte_count(prefiltered), [&](const ByteSink& out) { write_bytes(prefiltered, out); });
}

}  // namespace footprint
