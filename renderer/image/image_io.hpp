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

/// What the numbers of a file mean.
enum class Transfer {
  linear,   ///< data, such as normals and roughness: as stored, 0..1 for integers, whatever colours the file declares
  srgb,     ///< colours of a material: integers are decoded from sRGB, as glTF demands, floats converted to Rec. 709
  declared  ///< a picture: curve, primaries and orientation as its file declares; integers are sRGB without a word
};

/// An image and what else its file says.
struct FileImage {
  Image image{};
  bool floats = false;               ///< linear floats of any size, not integers that mean 0 to 1
  std::vector<std::string> notes{};  ///< what of the file is left out, one line each, without its name
};

/// Reads a PNG, JPEG, EXR, Radiance HDR, TIFF, BMP or WebP file, identified by its first bytes. Channels are chosen by
/// name (channel_names.hpp), 1 to 4 of them, including NaN and negative values in float files. Colours are never
/// multiplied by alpha, which is the last of 2 or 4 channels. Pixels are in their place in an EXR's display window; a
/// declared picture that stores a part of them has coverage 0 elsewhere, maps have 0. An HDR's order of pixels and its
/// exposure always count.
/// max_side: larger images are refused by their header, before memory is allocated.
/// Throws Error (usage): missing, empty, not an image, truncated, too large, an animation, channels or colours that
/// have no meaning for `transfer`; (machine): not enough memory.
[[nodiscard]] FileImage read_file_image(const std::filesystem::path& file, Transfer transfer, int max_side = 16384);

/// Reads the encoded bytes of a file, such as an image in a glTF buffer.
/// name: for error messages.
[[nodiscard]] FileImage read_file_image(std::span<const std::uint8_t> bytes, const std::string& name, Transfer transfer,
                                        int max_side = 16384);

/// The image alone, of a file or of its encoded bytes.
[[nodiscard]] Image read_image(const std::filesystem::path& file, Transfer transfer, int max_side = 16384);
[[nodiscard]] Image read_image(std::span<const std::uint8_t> bytes, const std::string& name, Transfer transfer,
                               int max_side = 16384);

/// Whether a file is an EXR, by its first bytes; false if it cannot be read.
[[nodiscard]] bool is_exr(const std::filesystem::path& file);

/// Whether a file's name has the extension of an image that read_image may read.
[[nodiscard]] bool names_an_image(const std::filesystem::path& file);

/// Writes 1, 3 or 4 channels as 32-bit float EXR (zip), atomically. Throws Error (machine): the folder cannot be
/// written, the disk is full; (check), once the file is written: values that are not finite, with the number of pixels.
void write_exr(const std::filesystem::path& file, const Image& image);

/// Writes 1, 3 or 4 channels of display values 0..1 (clamped, NaN as 0) as 8-bit PNG; atomic, and throws, as write_exr.
void write_png(const std::filesystem::path& file, const Image& image);

/// The bytes of a PNG, 8 bits per channel. name: for messages; texels: 1, 3 or 4 `channels`, interleaved. Throws Error
/// (machine): it cannot be encoded.
[[nodiscard]] std::vector<unsigned char> encoded_png(const std::string& name, int width, int height, int channels,
                                                     std::span<const std::uint8_t> texels);

/// Linear radiance to display: exposure, clamp, sRGB transfer curve; alpha stays, background is black. What is not
/// finite stays, for write_png to see.
[[nodiscard]] Image to_display(const Image& radiance, float exposure);

/// The number of texels by the header; 0 if read_image would refuse the file.
[[nodiscard]] std::uint64_t texels_in_header(const std::filesystem::path& file);
[[nodiscard]] std::uint64_t texels_in_header(std::span<const std::uint8_t> bytes);

/// How a channel of an EXR is stored.
enum class ExrTexel { half, full };

/// The levels of a map, finest first, and the names of its channels.
struct ExrChain {
  std::vector<Image> levels;
  std::vector<std::string> channels;
};

/// Writes all levels into one EXR, atomically; tiled and mip-mapped if there are several. Readers get the channels in
/// alphabetical order, except R, G, B and A.
/// chain: sizes as in mip_level_count, starting with the finest, or the finest only.
/// texel: `half` rounds to nearest.
/// Throws Error: as write_exr; std::logic_error: names and channels differ in number, or the sizes are not a chain.
void write_exr_chain(const std::filesystem::path& file, const ExrChain& chain, ExrTexel texel);

/// Reads all levels of an EXR, mip-mapped or not. Throws Error (usage): missing, not an EXR, damaged, too many
/// channels, over 16384 texels per side; (machine): not enough memory.
[[nodiscard]] ExrChain read_exr_chain(const std::filesystem::path& file, int most_channels = 16);

}  // namespace footprint
