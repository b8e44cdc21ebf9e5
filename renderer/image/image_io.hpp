// Images in and out of files, by OpenImageIO: EXR for linear radiance and mip chains, PNG for display, any format for
// textures.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "renderer/image/image.hpp"

namespace footprint {

/// How the numbers of a file become floats.
enum class Transfer {
  linear,  ///< as stored: 0..1 for integer formats, the value for float formats (normal maps, roughness, EXR)
  srgb,    ///< colour channels of integer formats are decoded from sRGB; alpha and float formats stay as they are
};

/// Reads a PNG, JPEG, EXR, Radiance HDR, TIFF, BMP or WebP file, told by its first bytes, whatever its name. Alpha is
/// never premultiplied; 1 to 4 channels come back as stored, NaN and negative values in float files too.
/// Throws Error (usage): missing, empty, not an image, truncated, over `max_side` texels per side (hostile size:
/// refused from the header, before memory is taken), no channel or more than four; (machine): not enough memory.
[[nodiscard]] Image read_image(const std::filesystem::path& file, Transfer transfer, int max_side = 16384);

/// The same from the encoded bytes of a file in memory (an image in a glTF buffer); `name` is for the error text.
[[nodiscard]] Image read_image(std::span<const std::uint8_t> bytes, const std::string& name, Transfer transfer,
                               int max_side = 16384);

/// Whether a file is an EXR, by its first bytes; false where it cannot be read.
[[nodiscard]] bool is_exr(const std::filesystem::path& file);

/// Writes 1, 3 or 4 channels as 32-bit float EXR (zip); written to a temporary neighbour and renamed, so the file
/// appears whole or not at all. Throws Error (machine): the folder cannot be written, the disk is full.
void write_exr(const std::filesystem::path& file, const Image& image);

/// Writes 1, 3 or 4 channels of display values 0..1 (clamped, NaN as 0) as 8-bit PNG; atomic as write_exr.
void write_png(const std::filesystem::path& file, const Image& image);

/// Linear radiance to display: exposure, clamp, sRGB transfer curve; alpha stays, background is black.
[[nodiscard]] Image to_display(const Image& radiance, float exposure);

/// Texels of a file that read_image reads, by its header; 0 where it would refuse it.
[[nodiscard]] std::uint64_t texels_in_header(const std::filesystem::path& file);
[[nodiscard]] std::uint64_t texels_in_header(std::span<const std::uint8_t> bytes);

/// How a channel of an EXR is stored.
enum class ExrTexel { half, full };

/// The levels of a map, finest first, and what its channels are called.
struct ExrChain {
  std::vector<Image> levels;
  std::vector<std::string> channels;
};

/// Writes all levels (sizes as mip_level_count has them, from the finest on; or the finest alone) into one EXR, tiled
/// and mip-mapped where there is more than one; whole or not at all. Channels come back in alphabetical order, but
/// for R, G, B and A. `half` rounds to nearest. Throws Error (machine): the folder cannot be written, the disk is full;
/// std::logic_error: as many names as channels are not there, or the sizes are no chain.
void write_exr_chain(const std::filesystem::path& file, const ExrChain& chain, ExrTexel texel);

/// Reads all levels of an EXR with at most `most_channels`, mip-mapped or not. Throws Error (usage): missing, no EXR,
/// damaged, more channels, over 16384 texels per side; (machine): not enough memory.
[[nodiscard]] ExrChain read_exr_chain(const std::filesystem::path& file, int most_channels = 16);

}  // namespace footprint
