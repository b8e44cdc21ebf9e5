// What a method bakes once per material: a plain value that one piece of code uploads, counts and tests.
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

/// How a channel is stored: what the GPU holds and what `bytes` counts.
enum class Storage { fp32, fp16, unorm8 };

[[nodiscard]] std::string_view storage_name(Storage storage);

/// Errors (usage) on a word that is no storage.
[[nodiscard]] Storage parse_storage(std::string_view word);

/// Whether texels are blended: as the program looks maps up; never (a mixture's lobes that have no counterpart in the
/// neighbour); always (a table that is no map: what it holds between texels is the same however the scene is sampled);
/// as the program looks maps up, but never by an anisotropic sampler (the module itself says which level it wants, and
/// what such a sampler makes of that, OpenGL does not say).
enum class TextureFilter { trilinear, nearest, linear, by_level };

/// Bytes of a channel.
[[nodiscard]] std::size_t channel_bytes(Storage storage);

/// One level of a texture, encoded in the texture's storage: layer after layer, rows from v = 0.
struct TextureLevel {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> bytes;  ///< none once they were freed: sizes stay

  friend bool operator==(const TextureLevel&, const TextureLevel&) = default;
};

/// A texture with its whole mip chain. The shader finds it as `sampler2D NAME`, or `sampler2DArray NAME` with layers.
struct PrefilteredTexture {
  std::string name;
  Storage storage = Storage::fp32;
  int channels = 4;  ///< 1 to 4
  int layers = 0;    ///< 0: a plain texture, else an array of so many
  TextureFilter filter = TextureFilter::trilinear;
  TextureCoordinates coordinates;    ///< those of the map that it prefilters
  std::vector<TextureLevel> levels;  ///< finest first, 1 x 1 last; one alone where nothing coarser is read
  bool built = false;                ///< a frame build writes the texels: levels have their sizes and no bytes

  friend bool operator==(const PrefilteredTexture&, const PrefilteredTexture&) = default;
};

/// The outcome of a precompute: everything that the method's shader reads besides the shared material.
struct Prefiltered {
  std::vector<PrefilteredTexture> textures;
  std::map<std::string, float> scalars;  ///< uniform float NAME
  std::vector<std::string> notes{};      ///< what a user should know of how it went, one sentence each; tables show it
  /// For each vertex of the material (triangles_of) its uv in textures that show each point of the surface once;
  /// none: the module looks at the maps' own coordinates alone.
  std::optional<std::vector<glm::vec2>> surface_coordinates{};

  friend bool operator==(const Prefiltered&, const Prefiltered&) = default;
};

/// Bytes of a texture as stored on the GPU, whether baked or built.
[[nodiscard]] std::size_t byte_count(const PrefilteredTexture& texture);

/// Bytes of all textures and scalars as stored on the GPU.
[[nodiscard]] std::size_t byte_count(const Prefiltered& prefiltered);

/// Tells textures apart whose texels differ, in number, storage or value: 64 bits of a hash of them. Their names and
/// coordinates do not count. Of texels that lie in memory.
[[nodiscard]] std::uint64_t texel_content(const PrefilteredTexture& texture);

/// Moves the textures of a container to the end of `textures`.
template <class Container>
void append(std::vector<PrefilteredTexture>& textures, Container more) {
  std::ranges::move(more, std::back_inserter(textures));
}

/// Frees the texels of a texture that is on the GPU; name and sizes remain.
void free_texels(PrefilteredTexture& texture);

/// Texels of the finest level of its largest map: what a figure per texel refers to. Tables that are no maps
/// (TextureFilter::linear) do not count. 0 without maps.
[[nodiscard]] std::size_t finest_texels(const Prefiltered& prefiltered);

/// Encodes a mip chain: fp16 and unorm8 round to nearest; unorm8 maps [-1,1] to 0..255 where `signed_range` (a
/// normal), else [0,1]. fp16 clamps to +-65504. Values must be finite. Each level is freed after it is encoded, so move
/// the chain in if nothing else reads it. Errors (machine): the encoded level does not fit in memory.
[[nodiscard]] PrefilteredTexture make_texture(std::string name, std::vector<Image> chain, Storage storage,
                                              const TextureCoordinates& coordinates, bool signed_range = false);

/// A texture of one level alone, likewise, which modules look up as that (`fetchFinest`).
[[nodiscard]] PrefilteredTexture make_level_texture(std::string name, Image level, Storage storage,
                                                    const TextureCoordinates& coordinates);

/// Encodes an array texture from one mip chain a layer, all of the same sizes and channels; otherwise as make_texture:
/// levels are given back too.
[[nodiscard]] PrefilteredTexture make_array_texture(std::string name, std::vector<std::vector<Image>> layers,
                                                    Storage storage, const TextureCoordinates& coordinates,
                                                    TextureFilter filter = TextureFilter::trilinear);

/// An array texture whose texels a frame build writes (frame_build.hpp).
struct BuiltTexture {
  std::string name;
  int width = 1, height = 1, layers = 1;
  int channels = 4;
  Storage storage = Storage::fp32;
  bool whole_chain = true;  ///< all levels, else the finest alone
};

/// Declares it: its levels have their sizes and no texels.
[[nodiscard]] PrefilteredTexture make_built_texture(const BuiltTexture& built, const TextureCoordinates& coordinates);

/// The floats that the shader reads from a level of a layer, before any decoding of a signed range. Errors:
/// std::logic_error for a texture that a frame build writes.
[[nodiscard]] Image decode_level(const PrefilteredTexture& texture, std::size_t index, int layer = 0);

}  // namespace footprint
