// A file or folder grows under a hidden name beside its target and is renamed to it once it is whole.
#include "renderer/core/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <system_error>
#include <utility>

#include "renderer/core/bytes.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/process.hpp"

namespace footprint {
namespace {

namespace fs = std::filesystem;

Error machine_error(const fs::path& path, std::string_view what, const std::error_code& why) {
  const bool full = why == std::errc::no_space_on_device || why == std::errc::file_too_large;
  return {ErrorKind::machine, path.string(), fmt::format("{}: {}", what, why.message()),
          full ? "free some space, or choose a folder on another disk" : "choose a folder that you can write to"};
}

std::error_code last_error() { return {errno, std::generic_category()}; }

// Where process ids count: the host's name and the namespace of ids. Others share the folder over a network.
const std::string& id_space() {
  static const std::string space = [] {
    std::error_code unknown;
    ContentHash hash;
    hash.add(host_name());
    hash.add(fs::read_symlink("/proc/self/ns/pid", unknown).string());
    return hash.hex().substr(0, 8);
  }();
  return space;
}

// The prefix of all hidden names of FOLDER/NAME.
std::string partial_prefix(const fs::path& name) { return fmt::format(".{}.partial-", name.string()); }

// The hidden name of FOLDER/NAME: process id, the space in which it is valid, and a number for further attempts of one
// process.
fs::path partial_path(const fs::path& folder, const fs::path& name, int attempt) {
  const std::string suffix = attempt == 0 ? std::string{} : fmt::format("-{}", attempt);
  return folder / fmt::format("{}{}-{}{}", partial_prefix(name), ::getpid(), id_space(), suffix);
}

// Whether the rest of a hidden name is of a process of this machine that has ended.
bool is_of_a_dead_process(std::string_view rest) {
  pid_t process = 0;
  const auto [end, status] = std::from_chars(rest.data(), rest.data() + rest.size(), process);
  if (status != std::errc{} || process <= 0) return false;
  const std::string_view space = rest.substr(static_cast<std::size_t>(end - rest.data()));
  if (!space.starts_with("-" + id_space())) return false;
  return ::kill(process, 0) != 0 && errno == ESRCH;
}

// Removes remains of killed processes. Failures are ignored.
void remove_dead_partials(const fs::path& folder, const fs::path& name) {
  const std::string prefix = partial_prefix(name);
  std::error_code ignored;
  std::vector<fs::path> dead;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.empty() ? "." : folder, ignored)) {
    const std::string found = entry.path().filename().string();
    if (found.starts_with(prefix) && is_of_a_dead_process(std::string_view(found).substr(prefix.size())))
      dead.push_back(entry.path());
  }
  for (const fs::path& path : dead) fs::remove_all(path, ignored);
}

// A new file beside `target`, closed and removed again unless it was renamed to it.
class TemporaryNeighbour {
 public:
  explicit TemporaryNeighbour(fs::path target) : target_(std::move(target)) {
    remove_dead_partials(target_.parent_path(), target_.filename());
    for (int attempt = 0; descriptor_ < 0; ++attempt) {
      path_ = partial_path(target_.parent_path(), target_.filename(), attempt);
      descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (descriptor_ < 0 && errno != EEXIST) throw machine_error(target_, "cannot be created", last_error());
    }
  }
  ~TemporaryNeighbour() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!renamed_) ::unlink(path_.c_str());
  }
  TemporaryNeighbour(const TemporaryNeighbour&) = delete;
  TemporaryNeighbour& operator=(const TemporaryNeighbour&) = delete;

  void write(std::span<const std::uint8_t> content) {
    while (!content.empty()) {
      const ssize_t written = ::write(descriptor_, content.data(), content.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) throw machine_error(target_, "cannot be written", last_error());
      content = content.subspan(static_cast<std::size_t>(written));
    }
  }

  // Network file systems report a full disk at the close.
  void close_and_rename() {
    if (::close(std::exchange(descriptor_, -1)) != 0) throw machine_error(target_, "cannot be written", last_error());
    if (::rename(path_.c_str(), target_.c_str()) != 0)
      throw machine_error(target_, "cannot be put in place", last_error());
    renamed_ = true;
  }

 private:
  fs::path target_, path_;
  int descriptor_ = -1;
  bool renamed_ = false;
};

// Renaming over a device or a pipe would replace it by a file.
void require_regular_or_absent(const fs::path& file) {
  std::error_code ignored;  // creating the file will fail with a message
  const fs::file_status status = fs::status(file, ignored);
  if (file.has_filename() && (!fs::exists(status) || fs::is_regular_file(status))) return;
  throw Error(ErrorKind::usage, file.string(), fs::is_directory(status) ? "is a folder" : "is not a regular file",
              "name a file to write");
}

// Creates missing parents of `folder` and appends them to `created`, outermost first.
void create_folders(const fs::path& folder, std::vector<fs::path>& created) {
  std::error_code status;
  if (!folder.has_relative_path() || fs::exists(folder, status)) return;
  create_folders(folder.parent_path(), created);
  if (fs::create_directory(folder, status)) created.push_back(folder);
  if (status) throw machine_error(folder, "cannot be created", status);
}

// Folders that others use by now are not empty and stay.
void remove_empty_folders(const std::vector<fs::path>& folders) {
  std::error_code ignored;
  std::for_each(folders.rbegin(), folders.rend(), [&](const fs::path& folder) { fs::remove(folder, ignored); });
}

fs::path create_staging(const fs::path& folder, const fs::path& final_path) {
  remove_dead_partials(folder, final_path.filename());
  for (int attempt = 0;; ++attempt) {
    fs::path staging = partial_path(folder, final_path.filename(), attempt);
    std::error_code status;
    if (fs::create_directory(staging, status)) return staging;
    if (status) throw machine_error(final_path, "cannot be created", status);
  }
}

std::vector<fs::path> relative_entries(const fs::path& folder) {
  std::vector<fs::path> entries;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    entries.push_back(entry.path().lexically_relative(folder));
  }
  std::ranges::sort(entries);  // folders before their content
  return entries;
}

// Files on top of an output folder describe the files below: a page, or a list of images.
bool lies_on_top(const fs::path& entry) { return !entry.has_parent_path(); }

// Links everything of `target` into `staging` that is not there and not stale, so that the two can be exchanged.
// Whether all of it could be linked: a file system may have no links.
bool link_what_stays(const fs::path& target, const fs::path& staging, const std::set<fs::path>& stale) {
  for (const fs::path& entry : relative_entries(target)) {
    if (stale.contains(entry) || fs::exists(fs::symlink_status(staging / entry))) continue;
    std::error_code status;
    if (fs::is_directory(fs::symlink_status(target / entry))) {
      fs::create_directory(staging / entry, status);
    } else if (::link((target / entry).c_str(), (staging / entry).c_str()) != 0) {
      return false;
    }
    if (status) return false;
  }
  return true;
}

// Exchanges each folder of `staging` with the one in `target` atomically. Folders that cannot be exchanged are left for
// merge_folder, which moves files.
void exchange_folders(const fs::path& staging, const fs::path& target, const std::vector<fs::path>& stale) {
  for (const auto& entry : fs::directory_iterator(staging)) {
    const fs::path name = entry.path().filename();
    if (!entry.is_directory() || !fs::is_directory(fs::symlink_status(target / name))) continue;
    std::set<fs::path> own_stale;
    for (const fs::path& file : stale) {
      if (*file.begin() == name) own_stale.insert(file.lexically_relative(name));
    }
    if (link_what_stays(target / name, staging / name, own_stale) &&
        ::renameat2(AT_FDCWD, (staging / name).c_str(), AT_FDCWD, (target / name).c_str(), RENAME_EXCHANGE) == 0)
      fs::remove_all(staging / name);
  }
}

// Moves all files of `staging` into the existing `target`, so that no moment has a list of one run over files of
// another: old files on top go first, new ones come last. Between them folders are exchanged, and `stale` goes.
void merge_folder(const fs::path& staging, const fs::path& target, const std::vector<fs::path>& stale) {
  const std::vector<fs::path> sorted = relative_entries(staging);
  std::vector<fs::path> entries = sorted;
  std::ranges::stable_partition(
      entries, [&](const fs::path& entry) { return fs::is_directory(staging / entry) || !lies_on_top(entry); });
  for (const fs::path& entry : entries) {
    if (!fs::exists(target / entry) || fs::is_directory(target / entry) == fs::is_directory(staging / entry)) continue;
    throw Error(
        ErrorKind::machine, (target / entry).string(),
        fs::is_directory(target / entry) ? "is a folder where a file belongs" : "is a file where a folder belongs",
        "move it away, or choose another output folder");
  }
  std::error_code ignored;
  for (const fs::path& entry : entries) {
    if (lies_on_top(entry) && !fs::is_directory(target / entry)) fs::remove(target / entry, ignored);
  }
  exchange_folders(staging, target, stale);
  for (const fs::path& file : stale) {
    if (!std::ranges::binary_search(sorted, file)) fs::remove(target / file, ignored);
  }
  for (const fs::path& entry : entries) {
    if (!fs::exists(fs::symlink_status(staging / entry))) continue;  // it was exchanged
    std::error_code status;
    if (fs::is_directory(staging / entry)) {
      fs::create_directory(target / entry, status);
    } else {
      fs::rename(staging / entry, target / entry, status);
    }
    if (status) throw machine_error(target / entry, "cannot be put in place", status);
  }
  fs::remove_all(staging);
}

}  // namespace

void write_file_atomically(const fs::path& file, const ByteWriter& write) {
  require_regular_or_absent(file);
  TemporaryNeighbour neighbour(file);
  write([&](std::span<const std::uint8_t> piece) { neighbour.write(piece); });
  neighbour.close_and_rename();
}

void write_file_atomically(const fs::path& file, std::span<const std::uint8_t> content) {
  write_file_atomically(file, [&](const ByteSink& out) { out(content); });
}

void write_file_atomically(const fs::path& file, std::string_view content) {
  write_file_atomically(file, std::span(reinterpret_cast<const std::uint8_t*>(content.data()), content.size()));
}

OutputFolder::OutputFolder(const fs::path& final_path) {
  const auto refuse = [&](const char* message) {
    throw Error(ErrorKind::usage, final_path.string(), message, "name a folder to write to");
  };
  if (final_path.empty()) refuse("an output folder has no name");
  final_ = fs::absolute(final_path).lexically_normal();
  if (!final_.has_filename()) final_ = final_.parent_path();  // "out/" is "out"
  if (!final_.has_filename()) refuse("is not an output folder");
  std::error_code ignored;
  const fs::file_status status = fs::status(final_, ignored);
  if (fs::exists(status) && !fs::is_directory(status)) refuse("is not a folder");
  if (!fs::exists(status) && fs::is_symlink(fs::symlink_status(final_, ignored))) refuse("is a link to nothing");
  const fs::path home = fs::exists(status) ? final_ : final_.parent_path();
  // The folder may have been created while such a process ran.
  if (fs::exists(final_.parent_path(), ignored)) remove_dead_partials(final_.parent_path(), final_.filename());
  try {
    create_folders(home, created_parents_);
    staging_ = create_staging(home, final_);
  } catch (const Error&) {
    remove_empty_folders(created_parents_);
    throw;
  }
}

OutputFolder::~OutputFolder() {
  if (committed_) return;
  std::error_code ignored;  // a destructor cannot report it
  fs::remove_all(path(), ignored);
  remove_empty_folders(created_parents_);
}

void OutputFolder::replaces(const std::vector<fs::path>& files) {
  for (const fs::path& file : files) {
    const fs::path path = file.lexically_normal();
    const bool inside = path.is_relative() && path.has_filename() && *path.begin() != "..";
    std::error_code ignored;
    if (inside && fs::is_regular_file(fs::symlink_status(final_ / path, ignored))) stale_.push_back(path);
  }
}

void OutputFolder::commit() {
  try {
    std::error_code status;
    if (!fs::exists(final_)) fs::rename(path(), final_, status);
    if (status) throw machine_error(final_, "cannot be put in place", status);
    if (fs::exists(path())) merge_folder(path(), final_, stale_);
  } catch (const fs::filesystem_error& failure) {
    throw machine_error(final_, "cannot be put in place", failure.code());
  }
  committed_ = true;
}

std::string file_text(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace footprint
