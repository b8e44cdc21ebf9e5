// Items and files, written whole, linked where that can be.
#include "experiments/kept/kept_work.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <utility>

#include "renderer/core/disk_cache.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/file_bytes.hpp"
#include "renderer/core/files.hpp"
#include "renderer/core/hash.hpp"

namespace footprint {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view form = "footprint-kept/1";
constexpr std::string_view ending = ".done";
constexpr std::uint64_t largest_file = std::uint64_t{64} << 30U;

// The bytes of a file; none where it cannot be read. An empty file is none that anything here writes.
std::optional<std::vector<std::uint8_t>> bytes_of(const fs::path& file) {
  try {
    return read_file_bytes(file, largest_file);
  } catch (const Error&) {
    return {};
  }
}

// With their number: two contents of one hash are of one size too, or are told apart.
std::string hash_of(std::span<const std::uint8_t> bytes) {
  ContentHash hash;
  hash.add(std::as_bytes(bytes));
  return fmt::format("{}-{}", hash.hex(), bytes.size());
}

// Parts come from elsewhere: what they name must lie in the folders that it is looked for in, and be put there.
bool is_word(std::string_view text) {
  constexpr std::string_view others = "-_";
  return !text.empty() && std::ranges::all_of(text, [&](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
           others.find(c) != std::string_view::npos;
  });
}

bool is_within(const fs::path& name) {
  return name.is_relative() && name.has_filename() && std::ranges::find(name, fs::path("..")) == name.end();
}

void make_folder(const fs::path& folder) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (!failed) return;
  throw Error(ErrorKind::machine, folder.string(), "cannot be created: " + failed.message(),
              "choose a folder that you can write to");
}

// The same file under a second name, or a copy where a link cannot be. Both names are only ever replaced by renaming,
// so that neither changes what is under the other.
void put(const fs::path& from, std::span<const std::uint8_t> bytes, const fs::path& to) {
  make_folder(to.parent_path());
  std::error_code failed;
  fs::remove(to, failed);
  fs::create_hard_link(from, to, failed);
  if (failed) write_file_atomically(to, bytes);
}

}  // namespace

KeptWork::KeptWork(fs::path folder, std::string maker, bool complete)
    : folder_(std::move(folder)), maker_(std::move(maker)), complete_(complete) {
  std::error_code unknown;
  const fs::file_status status = fs::status(folder_, unknown);
  if (!fs::exists(status) || fs::is_directory(status)) return;
  throw Error(ErrorKind::usage, folder_.string(), "is not a folder, and finished work is kept in one of this name",
              "move it away, or choose another output folder");
}

std::string KeptWork::key(std::string_view kind, std::span<const std::string> depends_on) const {
  ContentHash hash;
  hash.add(maker_);
  hash.add(kind);
  for (const std::string& field : depends_on) hash.add(field);
  return fmt::format("{}-{}", kind, hash.hex());
}

fs::path KeptWork::item_path(const std::string& key) const {
  return folder_ / key.substr(key.rfind('-') + 1, 2) / (key + std::string(ending));
}

fs::path KeptWork::file_path(const std::string& hash) const { return folder_ / "files" / hash.substr(0, 2) / hash; }

std::optional<KeptWork::Item> KeptWork::read(const std::string& key) const {
  const auto bytes = is_word(key) ? bytes_of(item_path(key)) : std::nullopt;
  if (!bytes) return {};
  std::optional<SealedReader> reader = SealedReader::open(*bytes, form);
  if (!reader || reader->get_text() != key) return {};
  Item item;
  for (std::uint64_t left = reader->get_count(2 * sizeof(std::uint64_t)); left > 0; --left) {
    KeptFile& file = item.files.emplace_back();
    file.name = reader->get_text();
    file.hash = reader->get_text();
    if (!is_within(file.name) || !is_word(file.hash)) return {};
  }
  item.value = reader->get_block();
  if (!reader->finished()) return {};
  return item;
}

bool KeptWork::is_whole(const KeptFile& file) const {
  const auto bytes = bytes_of(file_path(file.hash));
  return bytes && hash_of(*bytes) == file.hash;
}

bool KeptWork::has_whole(const std::string& key) const {
  const std::optional<Item> item = read(key);
  return item && std::ranges::all_of(item->files, [&](const KeptFile& file) { return is_whole(file); });
}

bool KeptWork::put_files(const Item& item, const fs::path& run_folder) const {
  for (const KeptFile& file : item.files) {
    const auto bytes = bytes_of(file_path(file.hash));
    if (!bytes || hash_of(*bytes) != file.hash) return false;
    put(file_path(file.hash), *bytes, run_folder / file.name);
  }
  return true;
}

void KeptWork::write(const std::string& key, std::span<const std::uint8_t> value, const fs::path& run_folder,
                     const std::vector<std::string>& files) const {
  make_folder(item_path(key).parent_path());
  const std::vector<std::uint8_t> item = sealed(form, [&](SealedWriter& writer) {
    writer.add_text(key);
    writer.add<std::uint64_t>(files.size());
    for (const std::string& name : files) {
      const std::vector<std::uint8_t> bytes = read_file_bytes(run_folder / name, largest_file);
      const std::string hash = hash_of(bytes);
      if (!is_whole({name, hash})) put(run_folder / name, bytes, file_path(hash));
      writer.add_text(name);
      writer.add_text(hash);
    }
    writer.add_block(value);
  });
  write_file_atomically(item_path(key), item);
  used_.insert(key);
}

std::vector<std::string> KeptWork::keys() const {
  std::vector<std::string> keys;
  std::error_code unknown;
  for (fs::recursive_directory_iterator entry(folder_, unknown), end; entry != end; entry.increment(unknown)) {
    if (entry->path().filename() == "files") entry.disable_recursion_pending();
    const std::string name = entry->path().filename().string();
    if (name.ends_with(ending) && name.front() != '.') keys.push_back(name.substr(0, name.size() - ending.size()));
  }
  std::ranges::sort(keys);
  return keys;
}

void KeptWork::take(const std::string& key, const KeptWork& from) const {
  const auto refuse = [&](const fs::path& file) {
    throw Error(ErrorKind::usage, file.string(), "is missing or damaged", "run that part again, and merge then");
  };
  const std::optional<Item> item = from.read(key);
  const auto item_bytes = bytes_of(from.item_path(key));
  if (!item_bytes || !item) refuse(from.item_path(key));
  make_folder(item_path(key).parent_path());
  for (const KeptFile& file : item->files) {
    const auto bytes = bytes_of(from.file_path(file.hash));
    if (!bytes || hash_of(*bytes) != file.hash) refuse(from.file_path(file.hash));
    if (!is_whole(file)) put(from.file_path(file.hash), *bytes, file_path(file.hash));
  }
  write_file_atomically(item_path(key), *item_bytes);
}

void KeptWork::require_more_allowed(const std::string& what) const {
  if (!complete_) return;
  throw Error(ErrorKind::usage, folder_.string(), fmt::format("lacks finished work of {}", what),
              "the scene, or a file of it, is not what it was when the parts were run: run them again");
}

void KeptWork::clear() const {
  std::error_code ignored;  // what stays is found damaged, or is as it was
  for (const std::string& key : keys()) {
    fs::remove(item_path(key), ignored);
    fs::remove(item_path(key).parent_path(), ignored);  // once it is empty
  }
  fs::remove_all(folder_ / "files", ignored);
  fs::remove(folder_, ignored);  // where nothing else lies in it
}

std::string maker_of_work(std::string_view renderer) {
  ContentHash hash;
  add_program(hash);
  return fmt::format("{} {}", hash.hex(), renderer);
}

bool is_made_by_this_program(std::string_view maker) { return maker.starts_with(maker_of_work("")); }

}  // namespace footprint
