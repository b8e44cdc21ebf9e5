// The result of a method's precompute for one material, as a plain value.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/image/image.hpp"
#include "renderer/scene/material.hpp"

namespace footprint {

/// How texels are stored on the GPU: each channel by itself, or blocks of 4 x 4 texels.
enum class Storage {
  fp32,
  fp16,
  unorm8,
  bc1,  ///< 3 channels, 8 bytes a block
  bc4,  ///< 1 channel, 8 bytes a block
  bc5   ///< 2 channels, 16 bytes a block
};

/// Whether a storage has blocks.
[[nodiscard]] bool is_block(Storage storage);

/// Whether it stores [0, 1] in steps of 1/255 or more.
[[nodiscard]] inline bool is_coarse(Storage storage) { return storage == Storage::unorm8 || is_block(storage); }

[[nodiscard]] std::string_view storage_name(Storage storage);

/// Throws Error (usage): not a storage.
[[nodiscard]] Storage parse_storage(std::string_view word);

/// Whether texels are blended.
enum class TextureFilter {
  trilinear,  ///< by the program's sampler state
  nearest,    ///< never: a mixture's lobes have no counterpart in the neighbouring texel
  linear,     ///< always: a table whose values between texels do not depend on the sampling of the scene
  by_level,   ///< by the program's state, but isotropic: OpenGL does not define anisotropy for explicit levels
};

/// Bytes of a channel, and of a whole block.
[[nodiscard]] std::size_t channel_bytes(Storage storage);

/// Bytes of one layer of a level. Blocks at its edges are whole.
[[nodiscard]] std::size_t level_bytes(Storage storage, int channels, int width, int height);

/// One level of a texture, encoded in the texture's storage: layer after layer, rows from v = 0.
struct TextureLevel {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> bytes;  ///< empty once they were freed; the size stays

  friend bool operator==(const TextureLevel&, const TextureLevel&) = default;
};

/// A texture with its mip chain, in shaders `sampler2D NAME`, or `sampler2DArray NAME` if it has layers.
struct PrefilteredTexture {
  std::string name;
  Storage storage = Storage::fp32;
  int channels = 4;  ///< 1 to 4
  int layers = 0;    ///< 0: a plain texture; otherwise an array
  TextureFilter filter = TextureFilter::trilinear;
  TextureCoordinates coordinates{};    ///< of the map that it filters
  std::vector<TextureLevel> levels{};  ///< finest first, 1 x 1 last; or only the finest
  bool built = false;                  ///< a frame build writes the texels; levels have sizes and no bytes

  friend bool operator==(const PrefilteredTexture&, const PrefilteredTexture&) = default;
};

/// The result of a precompute: all inputs of the method's shader except the shared material.
struct Prefiltered {
  std::vector<PrefilteredTexture> textures;
  std::map<std::string, float> scalars{};                   ///< uniform float NAME
  std::map<std::string, std::vector<glm::vec2>> vectors{};  ///< uniform vec2 NAME[size]; none is empty
  std::vector<std::string> notes{};  ///< remarks for the user, one sentence each, which tables show
  /// For each vertex of the material (collect_triangles): its uv in textures that show each point of the surface once.
  /// None: the module only uses the maps' own coordinates.
  std::optional<std::vector<glm::vec2>> surface_coordinates{};

  friend bool operator==(const Prefiltered&, const Prefiltered&) = default;
};

/// Bytes of a texture as stored on the GPU, whether baked or built.
[[nodiscard]] std::size_t byte_count(const PrefilteredTexture& texture);

/// Bytes of all textures, scalars and vectors, without padding of the uniform block.
[[nodiscard]] std::size_t byte_count(const Prefiltered& prefiltered);

/// A 64-bit hash of a texture's texels (number, storage and values), which must be in memory. Excludes names and
/// coordinates.
[[nodiscard]] std::uint64_t texel_content(const PrefilteredTexture& texture);

/// Moves the textures of a container to the end of `textures`.
template <class Container>
void append(std::vector<PrefilteredTexture>& textures, Container more) {
  std::ranges::move(more, std::back_inserter(textures));
}

/// Frees the texels of a texture that was uploaded; name and sizes stay.
void free_texels(PrefilteredTexture& texture);

/// Texels of the finest level of the largest map, for figures per texel. Excludes tables (TextureFilter::linear). 0
/// without maps.
[[nodiscard]] std::size_t finest_texels(const Prefiltered& prefiltered);

/// Encodes a mip chain; fp16 and unorm8 round to nearest, fp16 clamps to +-65504, and blocks are those of libsquish.
/// chain: finite values. Each level is freed once it is encoded, so move the chain in.
/// signed_range: unorm8 and blocks map [-1, 1], for normals, instead of [0, 1] to 0..255.
/// Throws Error (machine): the encoded level does not fit in memory.
[[nodiscard]] PrefilteredTexture make_texture(std::string name, std::vector<Image> chain, Storage storage,
                                              const TextureCoordinates& coordinates, bool signed_range = false);

/// Encodes a texture of one level, for `fetchFinest`.
[[nodiscard]] PrefilteredTexture make_level_texture(std::string name, Image level, Storage storage,
                                                    const TextureCoordinates& coordinates);

/// Encodes an array texture from one mip chain per layer, all of the same sizes and channels. Otherwise as
/// make_texture.
[[nodiscard]] PrefilteredTexture make_array_texture(std::string name, std::vector<std::vector<Image>> layers,
                                                    Storage storage, const TextureCoordinates& coordinates,
                                                    TextureFilter filter = TextureFilter::trilinear);

/// Integers as texels of four bytes, the lowest first, because textures return bytes exactly. Rows have `width` texels.
[[nodiscard]] PrefilteredTexture make_word_texture(std::string name, int width, std::span<const std::uint32_t> words);

/// Declares a texture whose texels a frame build writes (method.hpp): `texture` with levels that have sizes and no
/// texels.
/// whole_chain: all levels, otherwise only the finest.
[[nodiscard]] PrefilteredTexture make_built_texture(PrefilteredTexture texture, const glm::ivec2& size,
                                                    bool whole_chain = true);

/// The floats that the shader reads from a level of a layer, before it decodes a signed range. Throws std::logic_error:
/// a texture of a frame build.
[[nodiscard]] Image decode_level(const PrefilteredTexture& texture, std::size_t index, int layer = 0);

}  // namespace footprint
