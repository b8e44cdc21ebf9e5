// Files of a folder: named by a hash of what they hold the bake of, written whole, the oldest removed for room.
#include "renderer/bake/bake_cache.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <span>
#include <system_error>
#include <vector>

#include "renderer/bake/prefiltered_file.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/file_bytes.hpp"
#include "renderer/core/files.hpp"
#include "renderer/core/hash.hpp"
#include "renderer/scene/material_content.hpp"

namespace footprint {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view extension = ".bake";

constexpr std::uint64_t largest_file = std::uint64_t{64} << 30U;

// Empty where there is no such file or it cannot be read.
std::vector<std::uint8_t> content_of(const fs::path& file) {
  try {
    return read_file_bytes(file, largest_file);
  } catch (const Error&) {
    return {};
  }
}

// A change of the code changes what it bakes, and nobody remembers to raise a number.
const std::string& program_identity() {
  static const std::string identity = [] {
    ContentHash hash;
    const std::vector<std::uint8_t> program = content_of("/proc/self/exe");
    hash.add(std::as_bytes(std::span(program)));
    return hash.hex();
  }();
  return identity;
}

struct KeptFile {
  fs::path path;
  std::uintmax_t bytes;
  fs::file_time_type used;
};

std::vector<KeptFile> kept_files(const fs::path& folder) {
  std::vector<KeptFile> files;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    std::error_code gone;  // another process may remove it meanwhile
    const KeptFile file{.path = entry.path(), .bytes = entry.file_size(gone), .used = entry.last_write_time(gone)};
    if (!gone && file.path.extension() == extension) files.push_back(file);
  }
  return files;
}

}  // namespace

BakeCache::BakeCache(fs::path folder, std::uint64_t most_bytes) : folder_(std::move(folder)), most_bytes_(most_bytes) {}

std::string BakeCache::key(const std::string& method, const Material& material, const Options& options,
                           const EffectSet& effects) const {
  ContentHash hash;
  hash.add(program_identity());
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
  std::optional<Prefiltered> kept = from_bytes(content_of(file(key)));
  std::error_code ignored;  // a folder that cannot be written loses only the order of use
  if (kept) fs::last_write_time(file(key), fs::file_time_type::clock::now(), ignored);
  return kept;
}

void BakeCache::keep(const std::string& key, const Prefiltered& prefiltered) const {
  const std::vector<std::uint8_t> bytes = to_bytes(prefiltered);
  if (bytes.size() > most_bytes_) return;
  std::error_code failed;
  fs::create_directories(folder_, failed);
  if (failed) return;
  make_room(bytes.size());
  try {
    write_file_atomically(file(key), bytes);
  } catch (const Error&) {
    return;  // a full disk or a closed folder: the bake is at hand all the same
  }
}

void BakeCache::make_room(std::uint64_t bytes) const {
  std::vector<KeptFile> files = kept_files(folder_);
  std::ranges::sort(files, {}, &KeptFile::used);
  std::uint64_t total = bytes;
  for (const KeptFile& file : files) total += file.bytes;
  for (const KeptFile& file : files) {
    if (total <= most_bytes_) return;
    std::error_code ignored;
    if (fs::remove(file.path, ignored)) total -= file.bytes;
  }
}

std::optional<fs::path> default_cache_folder() {
  const auto variable = [](const char* name) -> std::optional<fs::path> {
    const char* const value = std::getenv(name);
    if (value == nullptr || *value == '\0') return {};
    return fs::path(value);
  };
  if (auto own = variable("FOOTPRINT_CACHE")) return own;
  if (const auto shared = variable("XDG_CACHE_HOME")) return *shared / "footprint";
  if (const auto home = variable("HOME")) return *home / ".cache" / "footprint";
  return {};
}

}  // namespace footprint
