// Files written whole, the oldest removed for room.
#include "renderer/core/disk_cache.hpp"

#include <algorithm>
#include <cstdlib>
#include <string_view>
#include <system_error>
#include <utility>

#include "renderer/core/bytes.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/files.hpp"

namespace footprint {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view extension = ".bake";

// The key follows the content, so that renamed or copied files are not accepted.
void write_with_key(const ByteSink& out, const ByteWriter& write, const std::string& key) {
  write(out);
  out({reinterpret_cast<const std::uint8_t*>(key.data()), key.size()});
}

// The content without the key; none if the key differs.
std::optional<ByteSource> without_key(const ByteSource& bytes, const std::string& key) {
  if (bytes.size() <= key.size()) return {};
  ByteSource before = bytes.first(bytes.size() - key.size());
  std::string last(key.size(), '\0');
  if (!bytes.read(before.size(), {reinterpret_cast<std::uint8_t*>(last.data()), last.size()}) || last != key) return {};
  return before;
}

struct CachedFile {
  fs::path path;
  std::uintmax_t bytes;
  fs::file_time_type used;
};

std::vector<CachedFile> cached_files(const fs::path& folder) {
  std::vector<CachedFile> files;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    std::error_code gone;  // another process may remove it meanwhile
    const CachedFile file{.path = entry.path(), .bytes = entry.file_size(gone), .used = entry.last_write_time(gone)};
    if (!gone && file.path.extension() == extension) files.push_back(file);
  }
  return files;
}

}  // namespace

DiskCache::DiskCache(fs::path folder, std::uint64_t most_bytes) : folder_(std::move(folder)), most_bytes_(most_bytes) {}

std::optional<ByteSource> DiskCache::find(const std::string& key) const {
  const std::optional<ByteSource> whole = ByteSource::of_file(file(key));
  std::optional<ByteSource> bytes = whole ? without_key(*whole, key) : std::nullopt;
  std::error_code ignored;  // a folder that cannot be written loses only the order of use
  if (bytes) fs::last_write_time(file(key), fs::file_time_type::clock::now(), ignored);
  return bytes;
}

void DiskCache::store(const std::string& key, std::span<const std::uint8_t> bytes) const {
  store(key, bytes.size(), [&](const ByteSink& out) { out(bytes); });
}

void DiskCache::store(const std::string& key, std::uint64_t bytes, const ByteWriter& write) const {
  if (bytes > most_bytes_) return;
  std::error_code failed;
  fs::create_directories(folder_, failed);
  if (failed) return;
  make_room(bytes);
  try {
    write_file_atomically(file(key), [&](const ByteSink& out) { write_with_key(out, write, key); });
  } catch (const Error&) {
    return;  // a full disk or a read-only folder only costs the caching
  }
}

void DiskCache::make_room(std::uint64_t bytes) const {
  std::vector<CachedFile> files = cached_files(folder_);
  std::ranges::sort(files, {}, &CachedFile::used);
  std::uint64_t total = bytes;
  for (const CachedFile& file : files) total += file.bytes;
  for (const CachedFile& file : files) {
    if (total <= most_bytes_) return;
    std::error_code ignored;
    if (fs::remove(file.path, ignored)) total -= file.bytes;
  }
}

void add_program(ContentHash& hash) {
  static const std::string identity = [] {
    ContentHash program;
    program.add(file_text("/proc/self/exe"));
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
