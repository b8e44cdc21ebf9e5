// Encoding of each storage, with rounding of our own, and back.
#include "renderer/bake/prefiltered.hpp"

#include <Imath/half.h>
#include <fmt/format.h>
#include <squish.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "renderer/core/bytes.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/memory.hpp"
#include "renderer/core/names.hpp"
#include "renderer/image/mipmap.hpp"

namespace footprint {
namespace {

constexpr auto storages = std::to_array<Word<Storage>>({{Storage::fp32, "fp32"},
                                                        {Storage::fp16, "fp16"},
                                                        {Storage::unorm8, "unorm8"},
                                                        {Storage::bc1, "bc1"},
                                                        {Storage::bc4, "bc4"},
                                                        {Storage::bc5, "bc5"}});
constexpr float largest_half = 65504.0F;

// Rounds to nearest, because the driver's own conversion truncates.
std::uint16_t half_bits(float value) { return half(std::clamp(value, -largest_half, largest_half)).bits(); }

std::uint8_t unorm8(float value, bool signed_range) {
  const float unit = signed_range ? value * 0.5F + 0.5F : value;
  return static_cast<std::uint8_t>(std::lround(std::clamp(unit, 0.0F, 1.0F) * 255.0F));
}

int block_channels(Storage storage) { return storage == Storage::bc1 ? 3 : storage == Storage::bc5 ? 2 : 1; }

int squish_format(Storage storage) {
  return storage == Storage::bc1 ? squish::kDxt1 : storage == Storage::bc4 ? squish::kBc4 : squish::kBc5;
}

// libsquish takes and gives four bytes a texel.
void encode_blocks(const Image& image, Storage storage, bool signed_range, std::uint8_t* out) {
  if (image.channels != block_channels(storage))
    throw std::logic_error(fmt::format("{} has no {} channels", storage_name(storage), image.channels));
  const auto channels = static_cast<std::size_t>(image.channels);
  std::vector<std::uint8_t> texels(4 * image.texel_count(), 255);
  for (std::size_t i = 0; i < image.texels.size(); ++i)
    texels[i / channels * 4 + i % channels] = unorm8(image.texels[i], signed_range);
  squish::CompressImage(texels.data(), image.width, image.height, out, squish_format(storage));
}

// The 16 values of a block of one channel (Direct3D 11 functional specification, 19.5.14), because libsquish 1.15
// encodes these blocks rightly and decodes them wrongly.
std::array<float, 16> decoded_channel(std::span<const std::uint8_t> block) {
  std::array<float, 8> ramp{static_cast<float>(block[0]), static_cast<float>(block[1]), 0, 0, 0, 0, 0, 255.0F};
  const bool is_long = block[0] > block[1];
  const int steps = is_long ? 7 : 5;
  for (int k = 1; k < steps; ++k)
    ramp.at(static_cast<std::size_t>(k + 1)) =
        (static_cast<float>(steps - k) * ramp[0] + static_cast<float>(k) * ramp[1]) / static_cast<float>(steps);
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < 6; ++i) bits |= std::uint64_t{block[2 + i]} << (8 * i);
  std::array<float, 16> values{};
  for (std::size_t i = 0; i < values.size(); ++i) values.at(i) = ramp.at(bits >> (3 * i) & 7U) / 255.0F;
  return values;
}

Image decode_channels(Storage storage, int width, int height, std::span<const std::uint8_t> bytes) {
  constexpr int side = 4;
  constexpr std::size_t channel_block = 8;
  Image image(width, height, block_channels(storage));
  for (int y = 0; y < height; y += side) {
    for (int x = 0; x < width; x += side) {
      for (std::size_t c = 0; c < static_cast<std::size_t>(image.channels); ++c) {
        const auto values = decoded_channel(bytes.first(channel_block));
        bytes = bytes.subspan(channel_block);
        for (int j = 0; j < side && y + j < height; ++j) {
          for (int i = 0; i < side && x + i < width; ++i)
            image.at(x + i, y + j)[c] = values.at(static_cast<std::size_t>(side * j + i));
        }
      }
    }
  }
  return image;
}

Image decode_blocks(Storage storage, int width, int height, std::span<const std::uint8_t> bytes) {
  if (storage != Storage::bc1) return decode_channels(storage, width, height, bytes);
  Image image(width, height, 3);
  std::vector<std::uint8_t> texels(4 * image.texel_count());
  squish::DecompressImage(texels.data(), width, height, bytes.data(), squish::kDxt1);
  for (std::size_t i = 0; i < image.texels.size(); ++i)
    image.texels[i] = static_cast<float>(texels[i / 3 * 4 + i % 3]) / 255.0F;
  return image;
}

// Appends the texels to `bytes` in their storage.
void encode(const Image& image, Storage storage, bool signed_range, std::vector<std::uint8_t>& bytes) {
  const std::size_t start = bytes.size();
  bytes.resize(start + level_bytes(storage, image.channels, image.width, image.height));
  std::uint8_t* const out = bytes.data() + start;
  if (is_block(storage)) return encode_blocks(image, storage, signed_range, out);
  if (storage == Storage::fp32) std::memcpy(out, image.texels.data(), image.texels.size() * sizeof(float));
  for (std::size_t i = 0; storage == Storage::fp16 && i < image.texels.size(); ++i) {
    const std::uint16_t bits = half_bits(image.texels[i]);
    std::memcpy(out + 2 * i, &bits, 2);
  }
  if (storage == Storage::unorm8)
    std::ranges::transform(image.texels, out, [&](float v) { return unorm8(v, signed_range); });
}

void require_finite(const std::string& name, const Image& level) {
  const auto bad = std::ranges::find_if(level.texels, [](float v) { return !std::isfinite(v); });
  if (bad == level.texels.end()) return;
  const auto texel = (bad - level.texels.begin()) / level.channels;
  throw Error(ErrorKind::usage, fmt::format("texture {}, level {}x{}", name, level.width, level.height),
              fmt::format("texel ({}, {}) is not finite", texel % level.width, texel / level.width),
              "fix the map that it was baked from");
}

// A plain texture of all levels of all layers, finest first. Each image is freed once it is encoded.
PrefilteredTexture encoded(std::string name, std::vector<std::vector<Image>> layers, Storage storage,
                           const TextureCoordinates& coordinates, bool signed_range) {
  PrefilteredTexture out{.name = std::move(name),
                         .storage = storage,
                         .channels = layers.front().front().channels,
                         .coordinates = coordinates,
                         .levels = {}};
  for (std::size_t i = 0; i < layers.front().size(); ++i) {
    const int width = layers.front()[i].width, height = layers.front()[i].height;
    const std::size_t bytes = layers.size() * level_bytes(storage, out.channels, width, height);
    require_texels(width, height, bytes, "a level of texture " + out.name);
    TextureLevel& level = out.levels.emplace_back(TextureLevel{.width = width, .height = height, .bytes = {}});
    level.bytes.reserve(bytes);
    for (std::vector<Image>& layer : layers) {
      Image& image = layer.at(i);
      if (image.width != width || image.height != height || image.channels != out.channels)
        throw std::logic_error("the layers of texture " + out.name + " differ in size");
      require_finite(out.name, image);
      encode(image, storage, signed_range, level.bytes);
      image = {};
    }
  }
  return out;
}

}  // namespace

std::string_view storage_name(Storage storage) { return word_for(storages, storage); }

std::size_t channel_bytes(Storage storage) {
  constexpr std::array<std::size_t, 6> bytes{4, 2, 1, 8, 8, 16};
  return bytes.at(static_cast<std::size_t>(storage));
}

bool is_block(Storage storage) { return storage >= Storage::bc1; }

std::size_t level_bytes(Storage storage, int channels, int width, int height) {
  constexpr std::size_t side = 4;
  const auto w = static_cast<std::size_t>(width), h = static_cast<std::size_t>(height);
  if (is_block(storage)) return (w + side - 1) / side * ((h + side - 1) / side) * channel_bytes(storage);
  return w * h * static_cast<std::size_t>(channels) * channel_bytes(storage);
}

Storage parse_storage(std::string_view word) { return word_value(storages, word, "storage", "storage"); }

std::size_t byte_count(const PrefilteredTexture& texture) {
  std::size_t bytes = 0;
  for (const TextureLevel& level : texture.levels)
    bytes += level_bytes(texture.storage, texture.channels, level.width, level.height);
  return bytes * static_cast<std::size_t>(std::max(texture.layers, 1));
}

std::size_t byte_count(const Prefiltered& prefiltered) {
  std::size_t bytes = prefiltered.scalars.size() * sizeof(float);
  for (const auto& [name, values] : prefiltered.vectors) bytes += values.size() * sizeof(glm::vec2);
  if (prefiltered.surface_coordinates) bytes += prefiltered.surface_coordinates->size() * sizeof(glm::vec2);
  for (const PrefilteredTexture& texture : prefiltered.textures) bytes += byte_count(texture);
  return bytes;
}

std::uint64_t texel_content(const PrefilteredTexture& texture) {
  std::uint64_t state = fnv1a_start;
  const auto add = [&](std::uint64_t value) { state = fnv1a(std::as_bytes(std::span(&value, 1)), state); };
  for (const int value : {static_cast<int>(texture.storage), texture.channels, texture.layers})
    add(static_cast<std::uint64_t>(value));
  for (const TextureLevel& level : texture.levels) {
    for (const int side : {level.width, level.height}) add(static_cast<std::uint64_t>(side));
    state = fnv1a(std::as_bytes(std::span(level.bytes)), state);
  }
  return state;
}

void free_texels(PrefilteredTexture& texture) {
  for (TextureLevel& level : texture.levels) std::vector<std::uint8_t>().swap(level.bytes);
}

std::size_t finest_texels(const Prefiltered& prefiltered) {
  std::size_t most = 0;
  for (const PrefilteredTexture& texture : prefiltered.textures) {
    if (texture.filter == TextureFilter::linear) continue;
    const TextureLevel& finest = texture.levels.front();
    most = std::max(most, static_cast<std::size_t>(finest.width) * static_cast<std::size_t>(finest.height));
  }
  return most;
}

PrefilteredTexture make_texture(std::string name, std::vector<Image> chain, Storage storage,
                                const TextureCoordinates& coordinates, bool signed_range) {
  std::vector<std::vector<Image>> layers;  // a list in braces would copy it
  layers.push_back(std::move(chain));
  return encoded(std::move(name), std::move(layers), storage, coordinates, signed_range);
}

PrefilteredTexture make_level_texture(std::string name, Image level, Storage storage,
                                      const TextureCoordinates& coordinates) {
  std::vector<Image> chain;  // a list in braces would copy it
  chain.push_back(std::move(level));
  PrefilteredTexture texture = make_texture(std::move(name), std::move(chain), storage, coordinates);
  texture.filter = TextureFilter::by_level;
  return texture;
}

PrefilteredTexture make_array_texture(std::string name, std::vector<std::vector<Image>> layers, Storage storage,
                                      const TextureCoordinates& coordinates, TextureFilter filter) {
  const std::size_t count = layers.size();
  PrefilteredTexture texture = encoded(std::move(name), std::move(layers), storage, coordinates, false);
  texture.layers = static_cast<int>(count);
  texture.filter = filter;
  return texture;
}

PrefilteredTexture make_word_texture(std::string name, int width, std::span<const std::uint32_t> words) {
  static_assert(std::endian::native == std::endian::little, "words are copied as they lie in memory");
  const auto row = static_cast<std::size_t>(width);
  const std::size_t rows = std::max<std::size_t>((words.size() + row - 1) / row, 1);
  TextureLevel level{.width = width, .height = static_cast<int>(rows), .bytes = {}};
  level.bytes.resize(4 * row * rows);
  if (!words.empty()) std::memcpy(level.bytes.data(), words.data(), words.size_bytes());
  PrefilteredTexture texture{.name = std::move(name), .storage = Storage::unorm8, .filter = TextureFilter::nearest};
  texture.levels.push_back(std::move(level));
  return texture;
}

PrefilteredTexture make_built_texture(PrefilteredTexture texture, const glm::ivec2& size, bool whole_chain) {
  texture.built = true;
  const int count = whole_chain ? mip_level_count(size.x, size.y) : 1;
  for (int level = 0; level < count; ++level)
    texture.levels.push_back(
        {.width = std::max(size.x >> level, 1), .height = std::max(size.y >> level, 1), .bytes = {}});
  return texture;
}

Image decode_level(const PrefilteredTexture& texture, std::size_t index, int layer) {
  if (texture.built)
    throw std::logic_error("texture " + texture.name + " is built on the GPU: there is nothing to decode");
  const TextureLevel& level = texture.levels.at(index);
  Image image(level.width, level.height, texture.channels);
  const std::size_t layer_bytes = level_bytes(texture.storage, texture.channels, level.width, level.height);
  const auto bytes = std::span(level.bytes).subspan(static_cast<std::size_t>(layer) * layer_bytes, layer_bytes);
  if (is_block(texture.storage)) return decode_blocks(texture.storage, level.width, level.height, bytes);
  if (texture.storage == Storage::fp32) std::memcpy(image.texels.data(), bytes.data(), bytes.size());
  for (std::size_t i = 0; texture.storage == Storage::fp16 && i < image.texels.size(); ++i) {
    std::uint16_t bits = 0;
    std::memcpy(&bits, bytes.data() + 2 * i, 2);
    image.texels[i] = imath_half_to_float(bits);
  }
  if (texture.storage == Storage::unorm8)
    std::ranges::transform(bytes, image.texels.begin(),
                           [](std::uint8_t byte) { return static_cast<float>(byte) / 255.0F; });
  return image;
}

}  // namespace footprint
