// Which files the results.json of an earlier run says that it wrote.
#pragma once

#include <filesystem>
#include <vector>

namespace footprint {

/// The pictures that a results.json of this program lists, relative to its folder; none where the file is not there, is
/// another program's, or cannot be read.
[[nodiscard]] std::vector<std::filesystem::path> listed_files(const std::filesystem::path& results_json);

}  // namespace footprint
