// The fields in order; what does not add up is no bake.
#include "renderer/bake/prefiltered_file.hpp"

#include <string>
#include <string_view>
#include <utility>

#include "renderer/core/sealed_bytes.hpp"

namespace footprint {
namespace {

constexpr std::string_view form = "footprint bake 5";  // another layout below: another number here

void add_texture(SealedWriter& out, const PrefilteredTexture& texture) {
  out.add_text(texture.name);
  out.add(texture.storage);
  out.add(texture.channels);
  out.add(texture.layers);
  out.add(texture.filter);
  out.add(texture.built);
  out.add(texture.coordinates.set);
  out.add(texture.coordinates.transform);
  out.add(texture.coordinates.wrap);
  out.add<std::uint64_t>(texture.levels.size());
  for (const TextureLevel& level : texture.levels) {
    out.add(level.width);
    out.add(level.height);
    out.add_block(level.bytes);
  }
}

PrefilteredTexture get_texture(SealedReader& in) {
  PrefilteredTexture texture;
  texture.name = in.get_text();
  texture.storage = in.get<Storage>();
  texture.channels = in.get<int>();
  texture.layers = in.get<int>();
  texture.filter = in.get<TextureFilter>();
  texture.built = in.get<bool>();
  texture.coordinates.set = in.get<int>();
  texture.coordinates.transform = in.get<glm::mat3x2>();
  texture.coordinates.wrap = in.get<std::array<Wrap, 2>>();
  for (std::uint64_t count = in.get_count(2 * sizeof(int)); count > 0; --count) {
    TextureLevel level;
    level.width = in.get<int>();
    level.height = in.get<int>();
    level.bytes = in.get_block();
    texture.levels.push_back(std::move(level));
  }
  return texture;
}

}  // namespace

void write_bytes(const Prefiltered& prefiltered, const ByteSink& sink) {
  SealedWriter out(form, sink);
  out.add<std::uint64_t>(prefiltered.textures.size());
  for (const PrefilteredTexture& texture : prefiltered.textures) add_texture(out, texture);
  out.add<std::uint64_t>(prefiltered.scalars.size());
  for (const auto& [name, value] : prefiltered.scalars) {
    out.add_text(name);
    out.add(value);
  }
  out.add<std::uint64_t>(prefiltered.notes.size());
  for (const std::string& note : prefiltered.notes) out.add_text(note);
  out.add(prefiltered.surface_coordinates.has_value());
  if (prefiltered.surface_coordinates) out.add_values(*prefiltered.surface_coordinates);
  std::move(out).seal();
}

std::optional<Prefiltered> from_bytes(const StoredBytes& bytes) {
  std::optional<SealedReader> opened = SealedReader::open(bytes, form);
  if (!opened) return {};
  SealedReader& in = *opened;
  Prefiltered prefiltered;
  for (std::uint64_t count = in.get_count(1); count > 0; --count) prefiltered.textures.push_back(get_texture(in));
  for (std::uint64_t count = in.get_count(1); count > 0; --count) {
    std::string name = in.get_text();
    prefiltered.scalars[std::move(name)] = in.get<float>();
  }
  for (std::uint64_t count = in.get_count(1); count > 0; --count) prefiltered.notes.push_back(in.get_text());
  if (in.get<bool>()) prefiltered.surface_coordinates = in.get_values<glm::vec2>();
  if (!in.finished()) return {};
  return prefiltered;
}

}  // namespace footprint
