// Slow precomputes stored on disk between runs, under a hash of all their inputs.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "renderer/bake/prefiltered.hpp"
#include "renderer/core/bytes.hpp"
#include "renderer/core/disk_cache.hpp"
#include "renderer/core/options.hpp"
#include "renderer/effects/effects.hpp"
#include "renderer/scene/material.hpp"

namespace footprint {

/// Writes the value with a checksum, in this machine's byte order. Equal values give equal bytes.
void write_bytes(const Prefiltered& prefiltered, const ByteSink& sink);

/// The value that `write_bytes` wrote; none if the bytes are truncated, too long, damaged or of another form.
[[nodiscard]] std::optional<Prefiltered> from_bytes(const ByteSource& bytes);

/// The bakes of methods in a DiskCache; damaged ones count as missing.
class BakeCache {
 public:
  explicit BakeCache(DiskCache files) : files_(std::move(files)) {}

  /// The key of a bake: the method's name, and a hash of this program's executable, the options, the effects and the
  /// material's values and maps. Another build of the program therefore bakes again.
  [[nodiscard]] std::string key(const std::string& method, const Material& material, const Options& options,
                                const EffectSet& effects) const;
  [[nodiscard]] std::optional<Prefiltered> find(const std::string& key) const;
  void store(const std::string& key, const Prefiltered& prefiltered) const;

 private:
  DiskCache files_;
};

}  // namespace footprint
