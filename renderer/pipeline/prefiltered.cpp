// See prefiltered.hpp.
#include "renderer/pipeline/prefiltered.hpp"

#include <Imath/half.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>

#include "renderer/core/error.hpp"
#include "renderer/core/suggest.hpp"

namespace footprint {
namespace {

constexpr std::array<std::pair<Storage, std::string_view>, 3> storages{
    {{Storage::fp32, "fp32"}, {Storage::fp16, "fp16"}, {Storage::unorm8, "unorm8"}}};
constexpr float largest_half = 65504.0F;

std::size_t channel_bytes(Storage storage) {
  switch (storage) {
    case Storage::fp32:
      return 4;
    case Storage::fp16:
      return 2;
    case Storage::unorm8:
      return 1;
  }
  return 0;
}

// The driver's own conversion truncates; ours rounds to nearest, so that storage costs what it must and no more.
std::uint16_t half_bits(float value) { return half(std::clamp(value, -largest_half, largest_half)).bits(); }

std::uint8_t unorm8(float value, bool signed_range) {
  const float unit = signed_range ? value * 0.5F + 0.5F : value;
  return static_cast<std::uint8_t>(std::lround(std::clamp(unit, 0.0F, 1.0F) * 255.0F));
}

TextureLevel encode(const Image& image, Storage storage, bool signed_range) {
  TextureLevel level{.width = image.width, .height = image.height, .bytes = {}};
  level.bytes.resize(image.texels.size() * channel_bytes(storage));
  switch (storage) {
    case Storage::fp32:
      std::memcpy(level.bytes.data(), image.texels.data(), level.bytes.size());
      break;
    case Storage::fp16:
      for (std::size_t i = 0; i < image.texels.size(); ++i) {
        const std::uint16_t bits = half_bits(image.texels[i]);
        std::memcpy(level.bytes.data() + 2 * i, &bits, 2);
      }
      break;
    case Storage::unorm8:
      std::ranges::transform(image.texels, level.bytes.begin(), [&](float v) { return unorm8(v, signed_range); });
      break;
  }
  return level;
}

}  // namespace

std::string_view storage_name(Storage storage) {
  return std::ranges::find(storages, storage, &std::pair<Storage, std::string_view>::first)->second;
}

Storage parse_storage(std::string_view word) {
  for (const auto& [storage, name] : storages) {
    if (name == word) return storage;
  }
  const std::vector<std::string> names{"fp32", "fp16", "unorm8"};
  throw Error(ErrorKind::usage, "storage", fmt::format("unknown storage `{}`", word), suggestion(word, names));
}

std::size_t byte_count(const Prefiltered& prefiltered) {
  std::size_t bytes = prefiltered.scalars.size() * sizeof(float);
  for (const PrefilteredTexture& texture : prefiltered.textures) {
    for (const TextureLevel& level : texture.levels) bytes += level.bytes.size();
  }
  return bytes;
}

PrefilteredTexture make_texture(std::string name, const std::vector<Image>& chain, Storage storage,
                                const TextureCoordinates& coordinates, bool signed_range) {
  PrefilteredTexture texture{.name = std::move(name),
                             .storage = storage,
                             .channels = chain.front().channels,
                             .coordinates = coordinates,
                             .levels = {}};
  for (const Image& level : chain) {
    const auto bad = std::ranges::find_if(level.texels, [](float v) { return !std::isfinite(v); });
    if (bad != level.texels.end()) {
      const auto texel = (bad - level.texels.begin()) / level.channels;
      throw Error(ErrorKind::usage, fmt::format("texture {}, level {}x{}", texture.name, level.width, level.height),
                  fmt::format("texel ({}, {}) is not finite", texel % level.width, texel / level.width),
                  "mend the map that it was baked from");
    }
    texture.levels.push_back(encode(level, storage, signed_range));
  }
  return texture;
}

Image decode_level(const PrefilteredTexture& texture, std::size_t index) {
  const TextureLevel& level = texture.levels.at(index);
  Image image(level.width, level.height, texture.channels);
  for (std::size_t i = 0; i < image.texels.size(); ++i) {
    switch (texture.storage) {
      case Storage::fp32:
        std::memcpy(&image.texels[i], level.bytes.data() + 4 * i, 4);
        break;
      case Storage::fp16: {
        half value;
        std::uint16_t bits = 0;
        std::memcpy(&bits, level.bytes.data() + 2 * i, 2);
        value.setBits(bits);
        image.texels[i] = value;
        break;
      }
      case Storage::unorm8:
        image.texels[i] = static_cast<float>(level.bytes[i]) / 255.0F;
        break;
    }
  }
  return image;
}

}  // namespace footprint
