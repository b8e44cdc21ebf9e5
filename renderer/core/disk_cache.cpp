// Files written whole, the oldest removed for room.
#include "renderer/core/disk_cache.hpp"

#include <algorithm>
#include <cstdlib>
#include <string_view>
#include <system_error>
#include <utility>

#include "renderer/core/error.hpp"
#include "renderer/core/file_bytes.hpp"
#include "renderer/core/files.hpp"

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

// Behind the bytes a file has its own key: one that was renamed, or copied over another, is none of this name.
std::vector<std::uint8_t> with_key(std::span<const std::uint8_t> bytes, const std::string& key) {
  std::vector<std::uint8_t> out;
  out.reserve(bytes.size() + key.size());
  out.assign(bytes.begin(), bytes.end());
  out.insert(out.end(), key.begin(), key.end());
  return out;
}

// The bytes before the key; none where the file ends in another.
std::vector<std::uint8_t> without_key(std::vector<std::uint8_t> bytes, const std::string& key) {
  const auto last = bytes.size() < key.size() ? bytes.begin() : bytes.end() - static_cast<std::ptrdiff_t>(key.size());
  if (!std::ranges::equal(last, bytes.end(), key.begin(), key.end())) return {};
  bytes.erase(last, bytes.end());
  return bytes;
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

DiskCache::DiskCache(fs::path folder, std::uint64_t most_bytes) : folder_(std::move(folder)), most_bytes_(most_bytes) {}

std::vector<std::uint8_t> DiskCache::find(const std::string& key) const {
  std::vector<std::uint8_t> bytes = without_key(content_of(file(key)), key);
  std::error_code ignored;  // a folder that cannot be written loses only the order of use
  if (!bytes.empty()) fs::last_write_time(file(key), fs::file_time_type::clock::now(), ignored);
  return bytes;
}

void DiskCache::keep(const std::string& key, std::span<const std::uint8_t> bytes) const {
  if (bytes.size() > most_bytes_) return;
  std::error_code failed;
  fs::create_directories(folder_, failed);
  if (failed) return;
  make_room(bytes.size());
  try {
    write_file_atomically(file(key), with_key(bytes, key));
  } catch (const Error&) {
    return;  // a full disk or a closed folder: what was made is at hand all the same
  }
}

void DiskCache::make_room(std::uint64_t bytes) const {
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

void add_program(ContentHash& hash) {
  static const std::string identity = [] {
    ContentHash program;
    const std::vector<std::uint8_t> bytes = content_of("/proc/self/exe");
    program.add(std::as_bytes(std::span(bytes)));
    return program.hex();
  }();
  hash.add(identity);
}

std::optional<fs::path> default_cache_folder() {
  const auto variable = [](const char* name) -> std::optional<fs::path> {
    const char* const value = std::getenv(name);
    if (value == nullptr || *value == '\0') return {};
    return fs::path(value);
  };
  if (auto own = variable("FOOTPRINT_CACHE")) return own;
  // Relative ones would make a cache of every folder that the program runs in (XDG Base Directory Specification: they
  // are to be ignored).
  if (const auto shared = variable("XDG_CACHE_HOME"); shared && shared->is_absolute()) return *shared / "footprint";
  if (const auto home = variable("HOME"); home && home->is_absolute()) return *home / ".cache" / "footprint";
  return {};
}

}  // namespace footprint
