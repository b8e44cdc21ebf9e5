// Whole files in memory, with the refusals that hostile paths need.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace footprint {

/// The bytes of a regular file. Errors (usage): missing, a folder or a device, empty, cannot be read, or larger than
/// `largest` bytes (refused before memory is taken).
[[nodiscard]] std::vector<std::uint8_t> read_file_bytes(const std::filesystem::path& file, std::uint64_t largest);

}  // namespace footprint
