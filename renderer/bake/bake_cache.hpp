// Slow precomputes kept on disk between runs, found again by the content of everything that they depend on.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "renderer/bake/prefiltered.hpp"
#include "renderer/core/disk_cache.hpp"
#include "renderer/core/options.hpp"
#include "renderer/effects/effects.hpp"
#include "renderer/scene/material.hpp"

namespace footprint {

/// The bakes of methods in a DiskCache; damaged ones count as absent.
class BakeCache {
 public:
  explicit BakeCache(DiskCache files) : files_(std::move(files)) {}

  /// Names a bake by this very program (its executable's bytes: another build bakes anew), the method, its options,
  /// the effects and the material's values and maps.
  [[nodiscard]] std::string key(const std::string& method, const Material& material, const Options& options,
                                const EffectSet& effects) const;
  [[nodiscard]] std::optional<Prefiltered> find(const std::string& key) const;
  void keep(const std::string& key, const Prefiltered& prefiltered) const;

 private:
  DiskCache files_;
};

}  // namespace footprint
