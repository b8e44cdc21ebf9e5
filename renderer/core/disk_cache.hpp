// A cache of slow work on disk: a folder of files named by hashes of their inputs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "renderer/core/bytes.hpp"

namespace footprint {

/// A folder of cached files. Files appear atomically; the least recently used ones are removed when the folder exceeds
/// its limit. A folder that cannot be read or written never fails a run.
class DiskCache {
 public:
  explicit DiskCache(std::filesystem::path folder, std::uint64_t most_bytes = std::uint64_t{8} << 30U);

  /// The bytes stored under `key` (letters, digits, `-` and `_`), marked as most recently used. None if there is no
  /// such file, or its content was stored under another key.
  [[nodiscard]] std::optional<ByteSource> find(const std::string& key) const;
  void store(const std::string& key, std::span<const std::uint8_t> bytes) const;
  /// Stores the output of `write` without a copy in memory.
  /// bytes: approximate size.
  void store(const std::string& key, std::uint64_t bytes, const ByteWriter& write) const;

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

 private:
  [[nodiscard]] std::filesystem::path file(const std::string& key) const { return folder_ / (key + ".bake"); }
  void make_room(std::uint64_t bytes) const;

  std::filesystem::path folder_;
  std::uint64_t most_bytes_;
};

/// Hashes the executable of this program, because its code determines the cached results.
void add_program(ContentHash& hash);

/// $FOOTPRINT_CACHE, else $XDG_CACHE_HOME/footprint, else $HOME/.cache/footprint; the latter two only if absolute. None
/// without any of them.
[[nodiscard]] std::optional<std::filesystem::path> default_cache_folder();

}  // namespace footprint
