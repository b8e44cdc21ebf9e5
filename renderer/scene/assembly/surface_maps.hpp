// Texture files to the maps that Material defines: normals with weights, roughness and metallic, RGBA colour.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "renderer/image/image_io.hpp"
#include "renderer/lobes/lobe.hpp"
#include "renderer/scene/map_texels.hpp"
#include "renderer/scene/material.hpp"
#include "renderer/scene/settings/part.hpp"

namespace footprint {

/// A decoded normal map and its faults.
struct NormalMap {
  Image image;               ///< Material::normal_map's four channels
  std::size_t invalid = 0;   ///< texels without a direction (weight 0)
  std::size_t inverted = 0;  ///< texels that point into the surface, projected onto it
};

/// Decodes stored normals, 2 c - 1 per channel. x and y are multiplied by `scale`, then the vector is normalised (glTF
/// 2.0, normalTexture). A texel shorter than 1e-3 or not finite becomes (0, 0, 1) with weight 0; z <= 0, or none left
/// by x and y, becomes a tiny positive z. Throws Error (usage): one channel.
[[nodiscard]] NormalMap decode_normal_map(const Image& stored, double scale,
                                          NormalChannels channels = NormalChannels::xyz);

/// Decodes unit normals, x, y, z of -1 to 1, otherwise as decode_normal_map. Throws Error (usage): one channel; most
/// texels are not unit vectors, with a hint if they seem to be encoded as 0 to 1.
[[nodiscard]] NormalMap decode_unit_normals(const Image& stored, double scale = 1.0,
                                            NormalChannels channels = NormalChannels::xyz);

/// Throws Error (usage): floats that should be (n + 1) / 2 are unit normals, x, y, z of -1 to 1.
void require_encoded_normals(const Image& stored, NormalChannels channels);

/// Reads a file of heights, or of normals: unit normals in an EXR, (n + 1) / 2 in all other formats. Adds faults, and
/// what is left out of the file, to `faults`. Throws Error (usage) that names the file: as the functions above,
/// normals_of_heights, require_encoded_normals and read_file_image.
[[nodiscard]] MapTexels read_normals(const NormalFile& file, std::vector<std::string>& faults);

/// The normals of a stored map, in the form that materials store. Adds faults, and what is left out of the file, to
/// `faults`.
/// decode: decode_normal_map, or decode_unit_normals for an EXR.
[[nodiscard]] MapTexels stored_normals(const FileImage& file, const std::function<NormalMap(const Image&)>& decode,
                                       const std::string& name, std::vector<std::string>& faults);

/// Notes on a map's file, one line each after `title`: what is left out of it, and whether its floats are the same
/// everywhere.
/// channels: those of the file that count.
/// title: such as "map `gloss.exr`".
[[nodiscard]] std::vector<std::string> describe_file(const FileImage& file, std::span<const std::size_t> channels,
                                                     const std::string& title);

/// The lines of describe_file for a map whose values mean 0 to 1, and the floats that are not: outside of that range,
/// or not finite.
/// channels: those that count in a file of three or more; otherwise the first counts.
[[nodiscard]] std::vector<std::string> describe_unit_values(const FileImage& file,
                                                            std::span<const std::size_t> channels,
                                                            const std::string& name);

/// Reads the file of such a map. Adds those lines to `warnings`. Throws as read_file_image.
[[nodiscard]] Image read_unit_map(const std::filesystem::path& file, Transfer transfer,
                                  std::span<const std::size_t> channels, std::vector<std::string>& warnings);

/// The channels of colours, of roughness beside metalness, and of a single quantity.
inline constexpr std::array<std::size_t, 3> color_channels{0, 1, 2};
inline constexpr std::array<std::size_t, 2> roughness_channels{1, 2};
inline constexpr std::array<std::size_t, 1> first_channel_alone{0};

/// Multiplies the slopes of a normal map by `strength`.
void scale_slopes(Image& normals, double strength);

/// The normals of a map of heights, in Material::normal_map's four channels. Texels are square, columns run along x,
/// rows against y, and heights rise along z.
/// stored: the height in the first channel, any finite number.
/// scale: the height of value 1 in widths of the map.
/// Throws Error (usage) that names the texel: a height that is not finite.
[[nodiscard]] Image normals_of_heights(const Image& stored, double scale, const HeightSettings& settings = {});

/// The faults of a normal map, one line each; empty without faults.
[[nodiscard]] std::vector<std::string> describe_faults(const NormalMap& map, const std::string& name);

/// The texel of `map` under the centre of the texel in column x, row y of a grid of width x height over the same area.
[[nodiscard]] std::span<const float> texel_under(const Image& map, int x, int y, int width, int height);

/// Two channels, roughness (from green) and metallic (from blue), each clamped to [0, 1] and times its factor. One or
/// two stored channels are grey.
[[nodiscard]] Image decode_metallic_roughness(const Image& stored, float roughness_factor, float metallic_factor);

/// One channel of a stored image, clamped to [0, 1] and times a factor; of a grey image its only one.
[[nodiscard]] Image decode_factor(const Image& stored, int channel, float factor);

/// One channel, the lobe parameter from the first stored one. Throws Error (usage) that names the texel: a value
/// outside of `least` to `most`.
[[nodiscard]] Image decode_lobe_parameter(const Image& stored, double least, double most);

/// A map of indices 0 to `count` - 1 in the first channel as one map per index: 1 where the index is its own, else 0.
/// Throws Error (usage) that names the texel: not an index.
[[nodiscard]] std::vector<Image> decode_indices(const Image& stored, std::size_t count);

/// Three channels, each clamped to [0, 1], from one (grey), two (grey, alpha), three or four.
[[nodiscard]] Image to_rgb(const Image& stored);

/// Four channels, each clamped to [0, 1], from one (grey), two (grey, alpha), three or four.
[[nodiscard]] Image to_rgba(const Image& stored);

/// Replaces the lobe of each texel by its effective lobe (`convolved`). The finer of both grids stays, with the nearest
/// texel of the other. kappa: 1 channel, above 0. Throws Error (usage): the material has several lobes, or a map of
/// their width with other coordinates.
void spread_normals(const TextureMap& kappa, Material& material);

}  // namespace footprint
