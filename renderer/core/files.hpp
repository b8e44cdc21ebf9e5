// Files and folders that appear whole or not at all.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "renderer/core/bytes.hpp"

namespace footprint {

/// Writes `content` to `file`, replacing what is there: into a temporary neighbour first, which is then renamed, so
/// that a reader sees the old file or the new one. On any failure the neighbour is removed and `file` is as it was;
/// neighbours whose process was killed go too.
/// Throws Error (machine): the folder cannot be written, the disk is full; (usage): `file` is there and is no regular
/// file.
void write_file_atomically(const std::filesystem::path& file, std::span<const std::uint8_t> content);
void write_file_atomically(const std::filesystem::path& file, std::string_view content);
/// Likewise, of content that is made while it is written. What `write` throws counts as a failure.
void write_file_atomically(const std::filesystem::path& file, const ByteWriter& write);

/// An output folder that is filled out of sight and moved to its place by `commit`; without a commit nothing is left
/// of it. What already lies in the final folder stays, but for files that are written again.
class OutputFolder {
 public:
  /// Creates the staging folder `.NAME.partial-PID-WHERE`, and removes those whose process was killed: beside the final
  /// one, or inside it where it exists already (it may be a mount point or a link, and its parent may be closed).
  /// Parents are created. Throws Error (usage): `final_path` is there and is no folder, or is empty; (machine): a
  /// folder cannot be created.
  explicit OutputFolder(const std::filesystem::path& final_path);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;
  OutputFolder(OutputFolder&&) = delete;
  OutputFolder& operator=(OutputFolder&&) = delete;

  /// Where to write until the commit.
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return staging_; }
  /// Where it will be: absolute, normalised.
  [[nodiscard]] const std::filesystem::path& final_path() const noexcept { return final_; }

  /// Names files of the final folder, relative to it, that an earlier run of the same kind wrote: the commit removes
  /// those that this one does not write again. What is no regular file inside of the folder stays.
  void replaces(const std::vector<std::filesystem::path>& files);

  /// Moves everything to the final place: in one step where no folder is there, else each subfolder in one step (file
  /// by file where the file system cannot exchange folders) and then each file on top by one rename. The files on top
  /// of the folder, which tell what is in it, are taken away before the first is moved and come back last: a process
  /// killed meanwhile leaves none of them over a mixture of two runs. Throws Error (machine): a rename fails, or a file
  /// would replace a folder or a folder a file; the latter is found before anything is moved.
  void commit();

 private:
  std::filesystem::path final_, staging_;
  std::vector<std::filesystem::path> stale_;            // of the final folder
  std::vector<std::filesystem::path> created_parents_;  // outermost first; removed again without a commit
  bool committed_ = false;
};

}  // namespace footprint
