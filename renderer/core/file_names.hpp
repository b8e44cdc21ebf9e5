// Names in lower case, and parts of file names made of what users call things.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace footprint {

/// ASCII letters in lower case; all else stays.
[[nodiscard]] std::string lower_case(std::string text);

/// A path's extension in lower case, with its dot.
[[nodiscard]] std::string lower_extension(const std::filesystem::path& path);

/// A file name part from any text: letters, digits, '-', '.' and '_' stay, all else becomes '_'.
[[nodiscard]] std::string file_stem(const std::string& text);

/// One for each name, in their order, none empty or hidden and all different, also where a file system takes upper and
/// lower case for one: a stem that comes twice has the name's number added.
[[nodiscard]] std::vector<std::string> distinct_stems(const std::vector<std::string>& names);

}  // namespace footprint
