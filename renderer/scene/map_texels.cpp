// Stores an image of floats, or a packed one with its decoder.
#include "renderer/scene/map_texels.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <optional>
#include <utility>

#include "renderer/core/memory.hpp"

namespace footprint {
namespace {

// Numbers values in the order in which they are met, by their bits; open addressing.
class ValueTable {
 public:
  // None if there are more values than 16-bit indices.
  std::optional<std::uint16_t> number_of(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    std::size_t slot = (bits * 2654435761U) >> (32 - slot_bits);  // Knuth's multiplicative hash
    while (numbers_[slot] != none && keys_[slot] != bits) slot = (slot + 1) % slots;
    if (numbers_[slot] == none) {
      if (values_.size() == most) return {};
      keys_[slot] = bits;
      numbers_[slot] = static_cast<std::int32_t>(values_.size());
      values_.push_back(value);
    }
    return static_cast<std::uint16_t>(numbers_[slot]);
  }
  [[nodiscard]] std::vector<float>& values() { return values_; }

 private:
  static constexpr int slot_bits = 17;  // twice as many as there are values
  static constexpr std::size_t slots = 1U << slot_bits, most = 1U << 16U;
  static constexpr std::int32_t none = -1;

  std::vector<std::uint32_t> keys_ = std::vector<std::uint32_t>(slots);
  std::vector<std::int32_t> numbers_ = std::vector<std::int32_t>(slots, none);
  std::vector<float> values_;
};

std::vector<float> channel_of(const Image& image, std::size_t channel) {
  std::vector<float> out(image.texel_count());
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = image.texels[i * static_cast<std::size_t>(image.channels) + channel];
  return out;
}

}  // namespace

PackedImage::PackedImage(const Image& image)
    : width_(image.width), height_(image.height), channels_(static_cast<std::size_t>(image.channels)) {
  tbb::parallel_for(std::size_t{0}, channels_.size(), [&](std::size_t c) { channels_[c] = pack(image, c); });
}

PackedImage::Channel PackedImage::pack(const Image& image, std::size_t channel) {
  constexpr std::size_t most_in_bytes = 256;
  ValueTable table;
  std::vector<std::uint16_t> numbers(image.texel_count());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const auto number = table.number_of(image.texels[i * static_cast<std::size_t>(image.channels) + channel]);
    if (!number) return {channel_of(image, channel), {}};
    numbers[i] = *number;
  }
  std::vector<float> values(table.values());  // no larger than it need be
  if (values.size() == 1) return {std::move(values), {}};
  if (values.size() > most_in_bytes) return {std::move(values), std::move(numbers)};
  std::vector<std::uint8_t> bytes(numbers.size());
  std::ranges::transform(numbers, bytes.begin(), [](std::uint16_t n) { return static_cast<std::uint8_t>(n); });
  return {std::move(values), std::move(bytes)};
}

Image PackedImage::unpacked() const {
  Image out(width_, height_, channels());
  const std::size_t stride = channels_.size();
  const auto fill = [&](std::size_t channel, std::size_t begin, std::size_t end, const auto& value_of) {
    for (std::size_t i = begin; i < end; ++i) out.texels[i * stride + channel] = value_of(i);
  };
  constexpr std::size_t texels_per_task = 65536;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, out.texel_count(), texels_per_task), [&](const auto& part) {
    for (std::size_t c = 0; c < stride; ++c) {
      const std::vector<float>& values = channels_[c].values;
      const std::size_t step = values.size() == 1 ? 0 : 1;  // a single value is used for all texels
      std::visit(
          [&](const auto& numbers) {
            if constexpr (std::is_same_v<std::decay_t<decltype(numbers)>, std::monostate>) {
              fill(c, part.begin(), part.end(), [&](std::size_t i) { return values[i * step]; });
            } else {
              fill(c, part.begin(), part.end(), [&](std::size_t i) { return values[numbers[i]]; });
            }
          },
          channels_[c].numbers);
    }
  });
  return out;
}

std::size_t PackedImage::byte_count() const {
  std::size_t bytes = 0;
  for (const Channel& channel : channels_) {
    bytes += channel.values.size() * sizeof(float);
    if (const auto* small = std::get_if<std::vector<std::uint8_t>>(&channel.numbers)) bytes += small->size();
    if (const auto* wide = std::get_if<std::vector<std::uint16_t>>(&channel.numbers)) bytes += 2 * wide->size();
  }
  return bytes;
}

struct MapTexels::Content {
  std::shared_ptr<const Image> floats;  // or else:
  PackedImage packed;
  Decode decode;             // none: the packed image is the map
  std::vector<float> first;  // texel of the map: as many channels as that has
  int width = 0, height = 0;

  [[nodiscard]] Image decoded() const {
    if (floats) return *floats;
    return decode ? decode(packed.unpacked()) : packed.unpacked();
  }
};

namespace {

std::vector<float> first_texel(const Image& image) {
  if (image.empty()) return {};
  return {image.at(0, 0).begin(), image.at(0, 0).end()};
}

}  // namespace

MapTexels::MapTexels(std::shared_ptr<const Image> image) {
  if (!image) return;
  Content content{.floats = {},
                  .packed = {},
                  .decode = {},
                  .first = first_texel(*image),
                  .width = image->width,
                  .height = image->height};
  content.floats = std::move(image);
  content_ = std::make_shared<const Content>(std::move(content));
}

MapTexels MapTexels::packed(const Image& image) { return packed(image, image, {}); }

MapTexels MapTexels::packed(const Image& map, const Image& stored, Decode decode) {
  MapTexels out;
  out.content_ = std::make_shared<const Content>(Content{.floats = {},
                                                         .packed = PackedImage(stored),
                                                         .decode = std::move(decode),
                                                         .first = first_texel(map),
                                                         .width = map.width,
                                                         .height = map.height});
  return out;
}

int MapTexels::width() const { return content_->width; }

int MapTexels::height() const { return content_->height; }

int MapTexels::channels() const { return static_cast<int>(content_->first.size()); }

std::size_t MapTexels::texel_count() const {
  return static_cast<std::size_t>(width()) * static_cast<std::size_t>(height());
}

std::span<const float> MapTexels::first() const { return content_->first; }

Image MapTexels::decoded() const {
  require_texels(width(), height(), texel_count() * content_->first.size() * sizeof(float), "a decoded map");
  return content_->decoded();
}

const void* MapTexels::identity() const {
  if (!content_) return nullptr;
  return content_->floats ? static_cast<const void*>(content_->floats.get()) : content_.get();
}

std::size_t MapTexels::byte_count() const {
  return content_->floats ? content_->floats->texels.size() * sizeof(float) : content_->packed.byte_count();
}

}  // namespace footprint
