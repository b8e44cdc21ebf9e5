// Which files the results.json of an earlier run says that it wrote.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace footprint {

/// The pictures that a results.json of this program lists, relative to its folder; none where the file is not there, is
/// another program's, or cannot be read.
[[nodiscard]] std::vector<std::filesystem::path> listed_files(const std::filesystem::path& results_json);

/// A reference that an earlier comparison wrote.
struct ListedReference {
  float exposure = 1.0F;                 ///< of that comparison
  std::filesystem::path standard_error;  ///< EXR
};

/// The entry of the reference FOLDER/images/NAME.exr in the results.json of FOLDER; none if that document is missing,
/// or it does not list that image as a reference.
[[nodiscard]] std::optional<ListedReference> listed_reference(const std::filesystem::path& reference);

/// The files below images/ in an output folder, as paths from it, sorted.
[[nodiscard]] std::vector<std::string> images_in(const std::filesystem::path& folder);

}  // namespace footprint
