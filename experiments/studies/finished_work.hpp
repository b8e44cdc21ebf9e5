// The finished parts of a run, on disk, from which an interrupted run resumes and of which `merge` makes one run.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/core/error.hpp"
#include "results/report/json_archive.hpp"

namespace footprint {

/// A folder with a JSON file per part, FOLDER/RUN/NAME.json, and the files that the part wrote, below FOLDER/RUN/. RUN
/// is the fingerprint of a run (run_fingerprint), NAME says which part. Both appear whole or not at all. A part that is
/// damaged, or a file of which is damaged or missing, counts as unfinished.
class FinishedWork {
 public:
  /// folder: created with the first part.
  /// maker: program and renderer (maker_of_work); a part of every fingerprint.
  /// complete: all parts must be there, and nothing may be measured.
  /// Errors (usage): `folder` exists and is not a folder.
  FinishedWork(std::filesystem::path folder, std::string maker, bool complete = false);

  /// Reads a part and puts its files into `output` under the names that they had.
  /// key: RUN/NAME.
  /// Returns nothing if the part is not finished. Errors (machine): `output` cannot be written.
  template <class T>
  [[nodiscard]] std::optional<T> find(const std::string& key, const std::filesystem::path& output) const {
    const std::optional<Part> part = read(key);
    if (!part) return {};
    try {
      T value = from_json_value<T>(part->value);
      put_files(key, *part, output);
      if (used_.insert(key).second) ++reused_;
      return value;
    } catch (const nlohmann::json::exception&) {
      return {};
    } catch (const Error& error) {
      if (error.kind() == ErrorKind::machine) throw;
      return {};
    }
  }

  /// Stores a part and the `files` of `output` (relative to it) that belong to it.
  /// Errors (machine): the folder cannot be written, the disk is full.
  template <class T>
  void store(const std::string& key, const T& value, const std::filesystem::path& output,
             const std::vector<std::string>& files = {}) const {
    write(key, to_json_value(value), output, files);
  }

  /// The keys that were found or stored through this object, sorted, and how many of them an earlier run had stored.
  [[nodiscard]] std::vector<std::string> used() const { return {used_.begin(), used_.end()}; }
  [[nodiscard]] std::size_t reused() const { return reused_; }

  /// Copies a part from another folder. Errors (usage): the part is missing or damaged there.
  void take(const std::string& key, const FinishedWork& from) const;

  /// Errors (usage): the work must be complete, and something of the `scene` is missing.
  void require_more_allowed(const std::string& scene) const;

  /// Removes all parts.
  void clear() const;

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  [[nodiscard]] const std::string& maker() const { return maker_; }
  /// Whether all parts must be there (`complete`).
  [[nodiscard]] bool is_complete() const { return complete_; }

 private:
  struct File {
    std::string name, hash;
  };
  struct Part {
    std::vector<File> files;
    nlohmann::ordered_json value;
  };
  [[nodiscard]] std::filesystem::path path_of(const std::string& key) const;
  [[nodiscard]] std::filesystem::path run_folder(const std::string& key) const;
  [[nodiscard]] std::optional<Part> read(const std::string& key) const;
  void put_files(const std::string& key, const Part& part, const std::filesystem::path& output) const;
  void write(const std::string& key, nlohmann::ordered_json value, const std::filesystem::path& output,
             const std::vector<std::string>& files) const;

  std::filesystem::path folder_;
  std::string maker_;
  bool complete_;
  mutable std::set<std::string> used_;  // what a run has found or stored is a log, not a part of the folder's value
  mutable std::size_t reused_ = 0;
};

/// The program and the renderer of an OpenGL context, for example "llvmpipe (LLVM 15.0.6, 256 bits)": images of another
/// program or renderer may differ, so its work is not reused.
[[nodiscard]] std::string maker_of_work(std::string_view renderer);

/// Whether this program, with any renderer, is that maker.
[[nodiscard]] bool is_made_by_this_program(std::string_view maker);

}  // namespace footprint
