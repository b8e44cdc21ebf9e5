// Parts as JSON under a checksum; files are hard links where the file system allows them.
#include "experiments/studies/finished_work.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <system_error>
#include <utility>

#include "renderer/core/bytes.hpp"
#include "renderer/core/disk_cache.hpp"
#include "renderer/core/files.hpp"

namespace footprint {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::uint64_t largest_file = std::uint64_t{64} << 30U;

std::optional<std::vector<std::uint8_t>> bytes_of(const fs::path& file) {
  try {
    return read_file_bytes(file, largest_file);
  } catch (const Error&) {
    return {};
  }
}

std::string hash_of(std::string_view text) {
  ContentHash hash;
  hash.add(text);
  return hash.hex();
}

std::string hash_of(const std::vector<std::uint8_t>& bytes) {
  ContentHash hash;
  hash.add(std::as_bytes(std::span(bytes)));
  return hash.hex();
}

std::string hash_of_file(const fs::path& file) {
  const auto bytes = bytes_of(file);
  return bytes ? hash_of(*bytes) : std::string();
}

// Parts come from other machines: a name must stay below the folder.
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

// The same file under a second name. Both names are only ever replaced by renaming, so neither changes the other.
void link_or_copy(const fs::path& from, const fs::path& to) {
  make_folder(to.parent_path());
  std::error_code failed;
  fs::remove(to, failed);
  fs::create_hard_link(from, to, failed);
  if (failed) write_file_atomically(to, read_file_bytes(from, largest_file));
}

}  // namespace

FinishedWork::FinishedWork(fs::path folder, std::string maker, bool complete)
    : folder_(std::move(folder)), maker_(std::move(maker)), complete_(complete) {
  std::error_code unknown;
  const fs::file_status status = fs::status(folder_, unknown);
  if (!fs::exists(status) || fs::is_directory(status)) return;
  throw Error(ErrorKind::usage, folder_.string(), "is not a folder, and a run stores its finished work in it",
              "move it away, or choose another output folder");
}

fs::path FinishedWork::path_of(const std::string& key) const { return folder_ / (key + ".json"); }

fs::path FinishedWork::run_folder(const std::string& key) const { return path_of(key).parent_path(); }

// The first line of a part is the hash of the rest.
std::optional<FinishedWork::Part> FinishedWork::read(const std::string& key) const {
  const auto bytes = is_within(key) ? bytes_of(path_of(key)) : std::nullopt;
  if (!bytes) return {};
  const std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  const std::size_t line = std::min(text.find('\n'), text.size() - 1);
  if (hash_of(text.substr(line + 1)) != text.substr(0, line)) return {};
  const Json document = Json::parse(text.substr(line + 1), nullptr, false);
  if (!document.is_object() || !document.contains("files") || !document.contains("value")) return {};
  if (!document.contains("key") || document["key"] != key) return {};
  Part part{.files = {}, .value = document["value"]};
  for (const auto& [name, hash] : document["files"].items()) {
    if (!is_within(name) || hash_of_file(run_folder(key) / name) != hash) return {};
    part.files.push_back({name, hash});
  }
  return part;
}

void FinishedWork::put_files(const std::string& key, const Part& part, const fs::path& output) const {
  for (const File& file : part.files) link_or_copy(run_folder(key) / file.name, output / file.name);
}

void FinishedWork::write(const std::string& key, Json value, const fs::path& output,
                         const std::vector<std::string>& files) const {
  Json hashes = Json::object();
  for (const std::string& name : files) {
    if (run_folder(key) != output) link_or_copy(output / name, run_folder(key) / name);
    hashes[name] = hash_of_file(output / name);
  }
  const Json document{{"key", key}, {"files", std::move(hashes)}, {"value", std::move(value)}};
  const std::string text = document.dump(1, ' ', false, Json::error_handler_t::replace);
  make_folder(run_folder(key));
  write_file_atomically(path_of(key), std::string_view(hash_of(text) + "\n" + text));
  used_.insert(key);
}

void FinishedWork::take(const std::string& key, const FinishedWork& from) const {
  const std::optional<Part> part = from.read(key);
  if (!part)
    throw Error(ErrorKind::usage, from.path_of(key).string(), "is missing or damaged, or one of its files is",
                "run that part again");
  std::vector<std::string> names;
  for (const File& file : part->files) names.push_back(file.name);
  write(key, part->value, from.run_folder(key), names);
}

void FinishedWork::require_more_allowed(const std::string& scene) const {
  if (!complete_) return;
  throw Error(ErrorKind::usage, folder_.string(), fmt::format("lacks finished work of {}", scene),
              "the scene, or a file of it, is not what it was when the parts were run: run them again");
}

void FinishedWork::clear() const {
  std::error_code ignored;  // a part that stays is complete or counts as unfinished
  fs::remove_all(folder_, ignored);
}

std::string maker_of_work(std::string_view renderer) {
  ContentHash hash;
  add_program(hash);
  return fmt::format("{} {}", hash.hex(), renderer);
}

bool is_made_by_this_program(std::string_view maker) { return maker.starts_with(maker_of_work("")); }

}  // namespace footprint
