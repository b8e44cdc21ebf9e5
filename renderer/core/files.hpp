// Files and folders that appear whole or not at all.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/core/bytes.hpp"
#include "renderer/core/run_folder.hpp"

namespace footprint {

/// Replaces `file` by `content` atomically: writes a temporary file next to it and renames that. On failure the
/// temporary file is removed and `file` unchanged; temporary files of killed processes are removed too.
/// Throws Error (machine): the folder cannot be written, the disk is full; (usage): `file` exists and is not a regular
/// file.
void write_file_atomically(const std::filesystem::path& file, std::span<const std::uint8_t> content);
void write_file_atomically(const std::filesystem::path& file, std::string_view content);
/// Replaces `file` by content that `write` produces piece by piece. Exceptions from `write` count as failures.
void write_file_atomically(const std::filesystem::path& file, const ByteWriter& write);

/// The whole content of a file; empty if there is none.
[[nodiscard]] std::string file_text(const std::filesystem::path& file);

/// An output folder that is filled in a hidden staging folder, and moved to its final place by `commit`. Without a
/// commit nothing remains. Other files in the final folder stay.
class OutputFolder {
 public:
  /// Creates the staging folder `.NAME.partial-PID-WHERE`, and missing parents, and removes staging folders of killed
  /// processes. It is next to the final folder, or inside it if that exists, because the folder may be a mount point or
  /// its parent read-only.
  /// Throws Error (usage): `final_path` is empty, or exists and is not a folder; (machine): a folder cannot be created.
  explicit OutputFolder(const std::filesystem::path& final_path);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;
  OutputFolder(OutputFolder&&) = delete;
  OutputFolder& operator=(OutputFolder&&) = delete;

  /// The folder to write to until the commit.
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return staging_.path(); }
  /// That folder as one of a run, with its losses.
  [[nodiscard]] const RunFolder& run() const noexcept { return staging_; }
  /// The final place: absolute, normalised.
  [[nodiscard]] const std::filesystem::path& final_path() const noexcept { return final_; }

  /// Files of the final folder, relative to it, that an earlier run wrote. The commit removes those that this run does
  /// not write again, if they are regular files inside the folder.
  void replaces(const std::vector<std::filesystem::path>& files);

  /// Moves everything to the final place. A missing folder is created by one rename. Otherwise each subfolder is
  /// exchanged in one step (file by file if the file system cannot exchange folders), and each file on top is renamed.
  /// Files on top describe the rest, so they are removed first and replaced last: a killed process leaves none of them
  /// over a mixture of two runs.
  /// Throws Error (machine): a rename fails, or a file would replace a folder or a folder a file. The latter is checked
  /// before anything is moved.
  void commit();

 private:
  std::filesystem::path final_;
  RunFolder staging_{std::filesystem::path()};
  std::vector<std::filesystem::path> stale_;            // of the final folder
  std::vector<std::filesystem::path> created_parents_;  // outermost first; removed again without a commit
  bool committed_ = false;
};

}  // namespace footprint
