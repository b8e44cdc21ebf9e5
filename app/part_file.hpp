// part.json: the description of a part of a run (docs/guides/cluster.md).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace footprint {

/// The number of a part and the number of parts, both from 1 on.
struct Shard {
  int index = 1, count = 1;
};

/// Reads "2/8". Errors (usage) of `--shard`.
[[nodiscard]] Shard parse_shard(const std::string& text);

/// The half-open range of `total` things that belong to a shard: the parts are next to each other and differ by one at
/// most.
[[nodiscard]] std::pair<std::size_t, std::size_t> range_of(const Shard& shard, std::size_t total);

/// The kinds of runs that have parts.
enum class PartKind { experiment, animation, region };

/// The content of one part.
struct PartFile {
  PartKind kind = PartKind::experiment;
  std::string experiment;   ///< its file, absolute; of an animation its scene
  std::string fingerprint;  ///< of the request (RequestedExperiments); of an animation the key of its head
  std::string maker = {};   ///< program and renderer (maker_of_work)
  Shard shard = {};
  std::string only = {};  ///< as the command line had it
  bool quick = false;
  int processes = 1, tile = 0;
  std::string node = {};               ///< that ran it
  double seconds = 0;                  ///< that it took, of the run that finished it
  std::vector<std::string> keys = {};  ///< of its finished work
};

/// Writes FOLDER/part.json whole. Errors (machine): cannot be written.
void write_part_file(const std::filesystem::path& folder, const PartFile& part);

/// Reads it. Errors (usage): it is missing or not whole, naming the file.
[[nodiscard]] PartFile read_part_file(const std::filesystem::path& folder);

}  // namespace footprint
