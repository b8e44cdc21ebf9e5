// Slow precomputes kept on disk between runs, found again by the content of everything that they depend on.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "renderer/bake/prefiltered.hpp"
#include "renderer/core/options.hpp"
#include "renderer/effects/effects.hpp"
#include "renderer/scene/material.hpp"

namespace footprint {

/// A folder of bakes. Files appear whole or not at all, and damaged ones count as absent; the least recently used go
/// when the folder outgrows its limit. A folder that cannot be read or written costs the saving, never the run.
class BakeCache {
 public:
  explicit BakeCache(std::filesystem::path folder, std::uint64_t most_bytes = std::uint64_t{8} << 30U);

  /// Names a bake by this very program (its executable's bytes: another build bakes anew), the method, its options,
  /// the effects and the material's values and maps.
  [[nodiscard]] std::string key(const std::string& method, const Material& material, const Options& options,
                                const EffectSet& effects) const;
  [[nodiscard]] std::optional<Prefiltered> find(const std::string& key) const;
  void keep(const std::string& key, const Prefiltered& prefiltered) const;

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

 private:
  [[nodiscard]] std::filesystem::path file(const std::string& key) const { return folder_ / (key + ".bake"); }
  void make_room(std::uint64_t bytes) const;

  std::filesystem::path folder_;
  std::uint64_t most_bytes_;
};

/// $FOOTPRINT_CACHE, else $XDG_CACHE_HOME/footprint, else $HOME/.cache/footprint; none where none of them is set.
[[nodiscard]] std::optional<std::filesystem::path> default_cache_folder();

}  // namespace footprint
