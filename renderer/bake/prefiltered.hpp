// The result of a method's bake of a material: a plain value that is uploaded, counted and tested in one way.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/image/image.hpp"
#include "renderer/scene/material.hpp"

namespace footprint {

/// The storage of a channel on the GPU, which `bytes` counts.
enum class Storage { fp32, fp16, unorm8 };

[[nodiscard]] std::string_view storage_name(Storage storage);

/// The storage of a word. Errors (usage): not a storage.
[[nodiscard]] Storage parse_storage(std::string_view word);

/// How texels are blended. trilinear: as the program looks maps up. nearest: never (lobes of a mixture without a
/// counterpart in the neighbour). linear: always (a table that is not a map, whose values between texels do not depend
/// on the sampling of the scene). by_level: as the program looks maps up, but without an anisotropic sampler, because
/// the module chooses the level and OpenGL does not define the result of such a sampler.
enum class TextureFilter { trilinear, nearest, linear, by_level };

/// Bytes of a channel.
[[nodiscard]] std::size_t channel_bytes(Storage storage);

/// One level of a texture, encoded in the texture's storage: layer after layer, rows from v = 0.
struct TextureLevel {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> bytes;  ///< empty after they were freed; sizes remain

  friend bool operator==(const TextureLevel&, const TextureLevel&) = default;
};

/// A texture with its whole mip chain. The shader reads it as `sampler2D NAME`, or as `sampler2DArray NAME` with
/// layers.
struct PrefilteredTexture {
  std::string name;
  Storage storage = Storage::fp32;
  int channels = 4;  ///< 1 to 4
  int layers = 0;    ///< 0: a plain texture; otherwise an array of this many layers
  TextureFilter filter = TextureFilter::trilinear;
  TextureCoordinates coordinates;    ///< of the map that it prefilters
  std::vector<TextureLevel> levels;  ///< finest first, 1 x 1 last; a single one if no coarser one is read
  bool built = false;                ///< a frame build writes the texels: levels have their sizes and no bytes

  friend bool operator==(const PrefilteredTexture&, const PrefilteredTexture&) = default;
};

/// The result of a precompute: all that the shader reads besides the shared material.
struct Prefiltered {
  std::vector<PrefilteredTexture> textures;
  std::map<std::string, float> scalars;  ///< uniform float NAME
  std::vector<std::string> notes{};      ///< notes for the user, one sentence each, which tables show
  /// For each vertex of the material (triangles_of) its uv in textures that show each point of the surface once. None
  /// if the module reads only the maps' own coordinates.
  std::optional<std::vector<glm::vec2>> surface_coordinates{};

  friend bool operator==(const Prefiltered&, const Prefiltered&) = default;
};

/// Bytes of a texture on the GPU, whether baked or built.
[[nodiscard]] std::size_t byte_count(const PrefilteredTexture& texture);

/// Bytes of all textures and scalars on the GPU.
[[nodiscard]] std::size_t byte_count(const Prefiltered& prefiltered);

/// A 64-bit hash of a texture's texels, their number and their storage, without name and coordinates. The texels must
/// be in memory.
[[nodiscard]] std::uint64_t texel_content(const PrefilteredTexture& texture);

/// Moves the textures of a container to the end of `textures`.
template <class Container>
void append(std::vector<PrefilteredTexture>& textures, Container more) {
  std::ranges::move(more, std::back_inserter(textures));
}

/// Frees the texels of a texture that is on the GPU; name and sizes remain.
void free_texels(PrefilteredTexture& texture);

/// Texels of the finest level of the largest map, which figures per texel refer to; 0 without maps. Tables that are not
/// maps (TextureFilter::linear) do not count.
[[nodiscard]] std::size_t finest_texels(const Prefiltered& prefiltered);

/// Encodes a mip chain: fp16 and unorm8 round to nearest; unorm8 maps [-1,1] to 0..255 where `signed_range` (a
/// normal), else [0,1]. fp16 clamps to +-65504. Values must be finite. Each level is freed after it is encoded, so move
/// the chain in if nothing else reads it. Errors (machine): the encoded level does not fit in memory.
[[nodiscard]] PrefilteredTexture make_texture(std::string name, std::vector<Image> chain, Storage storage,
                                              const TextureCoordinates& coordinates, bool signed_range = false);

/// A texture of a single level, which modules read by `fetchFinest`. Encodes as make_texture.
[[nodiscard]] PrefilteredTexture make_level_texture(std::string name, Image level, Storage storage,
                                                    const TextureCoordinates& coordinates);

/// Encodes an array texture from one mip chain per layer, all of the same sizes and channels. Encodes and frees levels
/// as make_texture.
[[nodiscard]] PrefilteredTexture make_array_texture(std::string name, std::vector<std::vector<Image>> layers,
                                                    Storage storage, const TextureCoordinates& coordinates,
                                                    TextureFilter filter = TextureFilter::trilinear);

/// An array texture that a frame build fills (frame_build.hpp).
struct BuiltTexture {
  std::string name;
  int width = 1, height = 1, layers = 1;
  int channels = 4;
  Storage storage = Storage::fp32;
  bool whole_chain = true;  ///< all levels; otherwise only the finest
};

/// Declares a built texture: levels with sizes and without texels.
[[nodiscard]] PrefilteredTexture make_built_texture(const BuiltTexture& built, const TextureCoordinates& coordinates);

/// The floats that the shader reads from a level of a layer, before it decodes a signed range. Errors: std::logic_error
/// for a built texture.
[[nodiscard]] Image decode_level(const PrefilteredTexture& texture, std::size_t index, int layer = 0);

}  // namespace footprint
