// The hash of all that a bake depends on, and what lies in the file of that name.
#include "renderer/bake/bake_cache.hpp"

#include <fmt/format.h>

#include <span>
#include <variant>

#include "renderer/bake/prefiltered_file.hpp"
#include "renderer/core/hash.hpp"
#include "renderer/scene/material_content.hpp"

namespace footprint {

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
  const std::optional<StoredBytes> kept = files_.find(key);
  return kept ? from_bytes(*kept) : std::nullopt;
}

void BakeCache::keep(const std::string& key, const Prefiltered& prefiltered) const {
  files_.keep(key, byte_count(prefiltered), [&](const ByteSink& out) { write_bytes(prefiltered, out); });
}

}  // namespace footprint
