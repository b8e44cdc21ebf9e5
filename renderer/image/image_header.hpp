// What a picture's file says of its size, without reading its texels.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

namespace footprint {

/// Texels of a file that read_image reads, by its header; 0 where it would refuse it.
[[nodiscard]] std::uint64_t texels_in_header(const std::filesystem::path& file);
[[nodiscard]] std::uint64_t texels_in_header(std::span<const std::uint8_t> bytes);

}  // namespace footprint
