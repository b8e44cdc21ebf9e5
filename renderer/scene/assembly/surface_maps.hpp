// Texture files to the maps that Material defines: normals with weights, roughness and metallic, RGBA colour.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "renderer/image/image.hpp"
#include "renderer/scene/map_texels.hpp"
#include "renderer/scene/material.hpp"

namespace footprint {

/// A decoded normal map and what was wrong with it.
struct NormalMap {
  Image image;               ///< Material::normal_map's four channels
  std::size_t invalid = 0;   ///< texels without a direction (weight 0)
  std::size_t inverted = 0;  ///< texels that point into the surface, laid flat onto it
};

/// Decodes stored normals, 2 c - 1 per channel; x and y are multiplied by `scale`, then the vector is renormalised
/// (glTF 2.0, normalTexture). A texel shorter than 1e-3 or not finite becomes (0, 0, 1) with weight 0; z <= 0 becomes a
/// tiny positive z, and so do x and y that leave nothing for z. Throws Error (usage): one channel.
[[nodiscard]] NormalMap decode_normal_map(const Image& stored, double scale,
                                          NormalChannels channels = NormalChannels::xyz);

/// Takes unit normals as they are, x, y, z of -1 to 1; the rest as above. Throws Error (usage): one channel; most
/// texels hold no unit vector, with a word on values that are encoded as 0 to 1.
[[nodiscard]] NormalMap decode_unit_normals(const Image& stored, double scale = 1.0,
                                            NormalChannels channels = NormalChannels::xyz);

/// The one rule for files of normals: an EXR holds unit normals as they are, every other format encodes them as
/// (n + 1) / 2. What is wrong with it is added to `faults`. Throws Error (usage) that names the file: as above, and of
/// read_image.
[[nodiscard]] MapTexels read_normal_map(const std::filesystem::path& file, double scale, NormalChannels channels,
                                        std::vector<std::string>& faults);

/// The normals of a stored map as a material keeps them, by `decode`, one of the functions above; what is wrong with
/// them is added to `faults`.
[[nodiscard]] MapTexels kept_normals(const Image& stored, const std::function<NormalMap(const Image&)>& decode,
                                     const std::string& name, std::vector<std::string>& faults);

/// Multiplies the slopes of a normal map by `strength`.
void scale_slopes(Image& normals, double strength);

/// The normals of a map of heights that tiles, by central differences: the first channel times `strength` is the height
/// in widths of the map. A texel next to a height that is not finite gets weight 0.
[[nodiscard]] NormalMap normals_of_heights(const Image& stored, double strength);

/// What is wrong with a normal map, one line each for the output; empty where nothing is.
[[nodiscard]] std::vector<std::string> describe_faults(const NormalMap& map, const std::string& name);

/// Two channels, roughness (stored in green) and metallic (blue), each clamped to [0, 1] and times its factor. One or
/// two stored channels count as grey.
[[nodiscard]] Image decode_metallic_roughness(const Image& stored, float roughness_factor, float metallic_factor);

/// One channel of a stored image within 0 to 1, times a factor; that of a grey image, whichever is asked for.
[[nodiscard]] Image decode_factor(const Image& stored, int channel, float factor);

/// One channel, the lobe parameter as stored in the first one. Throws Error (usage) that names the texel: a value that
/// is not within `least` to `most`.
[[nodiscard]] Image decode_lobe_parameter(const Image& stored, double least, double most);

/// A map of whole numbers 0 to `count` - 1 in the first channel, as a map for each: 1 where the number is its own, else
/// 0. Throws Error (usage) that names the texel: a value that is no whole number within that range.
[[nodiscard]] std::vector<Image> decode_indices(const Image& stored, std::size_t count);

/// Three channels, each clamped to [0, 1], from one (grey), two (grey, alpha), three or four.
[[nodiscard]] Image to_rgb(const Image& stored);

/// Four channels, each clamped to [0, 1], from one (grey), two (grey, alpha), three or four.
[[nodiscard]] Image to_rgba(const Image& stored);

}  // namespace footprint
