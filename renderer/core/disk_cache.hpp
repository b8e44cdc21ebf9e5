// Slow work kept on disk between runs: a folder of files that are named by the content of what they were made from.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "renderer/core/bytes.hpp"
#include "renderer/core/hash.hpp"

namespace footprint {

/// A folder of bakes. Files appear whole or not at all; the least recently used go when the folder outgrows its limit.
/// A folder that cannot be read or written costs the saving, never the run.
class DiskCache {
 public:
  explicit DiskCache(std::filesystem::path folder, std::uint64_t most_bytes = std::uint64_t{8} << 30U);

  /// The bytes kept under `key` (letters, digits, `-` and `_`), now the most recently used, to be read from the disk;
  /// none where there are none, or those in the file were kept under another.
  [[nodiscard]] std::optional<ByteSource> find(const std::string& key) const;
  void store(const std::string& key, std::span<const std::uint8_t> bytes) const;
  /// Keeps what `write` hands over, about so many bytes, without holding it in memory.
  void store(const std::string& key, std::uint64_t bytes, const ByteWriter& write) const;

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

 private:
  [[nodiscard]] std::filesystem::path file(const std::string& key) const { return folder_ / (key + ".bake"); }
  void make_room(std::uint64_t bytes) const;

  std::filesystem::path folder_;
  std::uint64_t most_bytes_;
};

/// Counts the bytes of this very program's executable: a change of the code changes what it makes, and nobody remembers
/// to raise a number.
void add_program(ContentHash& hash);

/// $FOOTPRINT_CACHE, else $XDG_CACHE_HOME/footprint, else $HOME/.cache/footprint; none where none of them is set.
/// The latter two count where they are absolute.
[[nodiscard]] std::optional<std::filesystem::path> default_cache_folder();

}  // namespace footprint
