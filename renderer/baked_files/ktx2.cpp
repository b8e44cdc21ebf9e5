// The parts of the file in their order; sections and tables are those of the KTX 2.0 specification and, for the data
// format descriptor, of the Khronos Data Format Specification 1.3.
#include "renderer/baked_files/baked_files.hpp"

#include <array>
#include <bit>
#include <numeric>
#include <stdexcept>
#include <string_view>

namespace footprint {
namespace {

constexpr std::array<std::uint8_t, 12> identifier{0xAB, 'K', 'T', 'X', ' ', '2', '0', 0xBB, '\r', '\n', 0x1A, '\n'};
constexpr std::size_t header_bytes = 80;       // identifier, nine words, and the index of four words and two long ones
constexpr std::size_t level_entry_bytes = 24;  // offset, length, uncompressed length
constexpr std::uint32_t block_version = 2;     // of a basic descriptor block: KDFS 1.3
constexpr std::uint32_t primaries_unspecified = 0, transfer_linear = 1;
constexpr std::uint32_t type_signed_float = 0xC0;  // qualifiers of a channel: float and signed

class Bytes {
 public:
  void word(std::uint32_t value) { number(value, 4); }
  void long_word(std::uint64_t value) { number(value, 8); }
  void text(std::string_view text) { bytes_.insert(bytes_.end(), text.begin(), text.end()); }
  void block(const std::vector<std::uint8_t>& block) { bytes_.insert(bytes_.end(), block.begin(), block.end()); }
  void pad_to(std::size_t size) { bytes_.resize(size, 0); }
  [[nodiscard]] std::size_t size() const { return bytes_.size(); }
  [[nodiscard]] std::vector<std::uint8_t> take() { return std::move(bytes_); }

 private:
  void number(std::uint64_t value, int count) {
    for (int i = 0; i < count; ++i) bytes_.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
  }

  std::vector<std::uint8_t> bytes_;
};

// Of a texel, or of a block.
std::size_t texel_size(const PrefilteredTexture& texture) {
  return level_bytes(texture.storage, texture.channels, 1, 1);
}

std::size_t rounded_up(std::size_t size, std::size_t step) { return (size + step - 1) / step * step; }

// A sample of a descriptor: its first bit, its last bit from there, channel, and the numbers that mean 0 (or -1) and 1.
struct Sample {
  std::uint32_t offset, last_bit, channel, lower, upper;
};

// One sample per channel; of blocks 64 bits each (KDFS 1.3, section 5.6), two of BC5 and one of the others.
std::vector<Sample> samples_of(const PrefilteredTexture& texture) {
  if (texture.storage == Storage::bc5) return {{0, 63, 0, 0, 0xFFFFFFFF}, {64, 63, 1, 0, 0xFFFFFFFF}};
  if (is_block(texture.storage)) return {{0, 63, 0, 0, 0xFFFFFFFF}};
  const auto bits = static_cast<std::uint32_t>(8 * channel_bytes(texture.storage));
  std::vector<Sample> samples;
  for (std::uint32_t c = 0; c < static_cast<std::uint32_t>(texture.channels); ++c) {
    const std::uint32_t id = c == 3 ? 15 : c;  // alpha is 15
    if (texture.storage == Storage::unorm8) {
      samples.push_back({c * bits, bits - 1, id, 0, 255});
    } else {
      samples.push_back({c * bits, bits - 1, id | type_signed_float, std::bit_cast<std::uint32_t>(-1.0F),
                         std::bit_cast<std::uint32_t>(1.0F)});
    }
  }
  return samples;
}

std::uint32_t color_model(Storage storage) {
  constexpr std::uint32_t model_rgbsda = 1, model_bc1 = 128, model_bc4 = 131, model_bc5 = 132;
  if (!is_block(storage)) return model_rgbsda;
  return storage == Storage::bc1 ? model_bc1 : storage == Storage::bc4 ? model_bc4 : model_bc5;
}

// KDFS 1.3, section 5: one basic block of Khronos' own.
std::vector<std::uint8_t> format_descriptor(const PrefilteredTexture& texture) {
  const std::vector<Sample> samples = samples_of(texture);
  const auto block_size = static_cast<std::uint32_t>(24 + 16 * samples.size());
  Bytes out;
  out.word(4 + block_size);
  out.word(0);
  out.word(block_version | block_size << 16);
  out.word(color_model(texture.storage) | primaries_unspecified << 8 | transfer_linear << 16);
  out.word(is_block(texture.storage) ? 3 | 3 << 8 : 0);       // texel blocks of 4 x 4 x 1 x 1, or of one texel
  out.word(static_cast<std::uint32_t>(texel_size(texture)));  // bytes of plane 0
  out.word(0);
  for (const Sample& sample : samples) {
    out.word(sample.offset | sample.last_bit << 16 | sample.channel << 24);
    out.word(0);  // its place in the block
    out.word(sample.lower);
    out.word(sample.upper);
  }
  return out.take();
}

// In the order of the keys, each with its length in front and filled up to four bytes.
std::vector<std::uint8_t> key_values() {
  using namespace std::string_view_literals;
  Bytes out;
  for (const std::string_view entry : {"KTXorientation\0rd\0"sv, "KTXwriter\0footprint bake\0"sv}) {
    out.word(static_cast<std::uint32_t>(entry.size()));
    out.text(entry);
    out.pad_to(rounded_up(out.size(), 4));
  }
  return out.take();
}

// Where each level's bytes begin, `first` being the first free byte: the coarsest comes first.
std::vector<std::size_t> level_offsets(const PrefilteredTexture& texture, std::size_t first) {
  const std::size_t step = std::lcm(texel_size(texture), std::size_t{4});
  std::vector<std::size_t> offsets(texture.levels.size());
  for (std::size_t level = offsets.size(); level-- > 0;) {
    offsets[level] = rounded_up(first, step);
    first = offsets[level] + texture.levels[level].bytes.size();
  }
  return offsets;
}

}  // namespace

std::uint32_t vk_format(Storage storage, int channels) {
  if (storage == Storage::bc1) return 131;  // VK_FORMAT_BC1_RGB_UNORM_BLOCK
  if (storage == Storage::bc4) return 139;  // VK_FORMAT_BC4_UNORM_BLOCK
  if (storage == Storage::bc5) return 141;  // VK_FORMAT_BC5_UNORM_BLOCK
  constexpr std::array<std::array<std::uint32_t, 4>, 3> formats{{
      {100, 103, 106, 109},  // VK_FORMAT_R32_SFLOAT, R32G32, R32G32B32, R32G32B32A32
      {76, 83, 90, 97},      // VK_FORMAT_R16_SFLOAT, ...
      {9, 16, 23, 37},       // VK_FORMAT_R8_UNORM, R8G8, R8G8B8, R8G8B8A8
  }};
  return formats.at(static_cast<std::size_t>(storage)).at(static_cast<std::size_t>(channels - 1));
}

std::vector<std::uint8_t> ktx2_bytes(const PrefilteredTexture& texture) {
  if (texture.built) throw std::logic_error("texture " + texture.name + " is built on the GPU: it has no texels");
  const std::vector<std::uint8_t> descriptor = format_descriptor(texture), keys = key_values();
  const std::size_t descriptor_at = header_bytes + level_entry_bytes * texture.levels.size();
  const std::size_t keys_at = descriptor_at + descriptor.size();
  const std::vector<std::size_t> offsets = level_offsets(texture, keys_at + keys.size());
  Bytes out;
  out.block({identifier.begin(), identifier.end()});
  out.word(vk_format(texture.storage, texture.channels));
  const std::size_t type_size = is_block(texture.storage) ? 1 : channel_bytes(texture.storage);
  out.word(static_cast<std::uint32_t>(type_size));  // the unit of byte order
  out.word(static_cast<std::uint32_t>(texture.levels.front().width));
  out.word(static_cast<std::uint32_t>(texture.levels.front().height));
  out.word(0);  // no depth
  out.word(static_cast<std::uint32_t>(texture.layers));
  out.word(1);  // one face
  out.word(static_cast<std::uint32_t>(texture.levels.size()));
  out.word(0);  // no supercompression, and so no global data
  out.word(static_cast<std::uint32_t>(descriptor_at));
  out.word(static_cast<std::uint32_t>(descriptor.size()));
  out.word(static_cast<std::uint32_t>(keys_at));
  out.word(static_cast<std::uint32_t>(keys.size()));
  out.long_word(0);
  out.long_word(0);
  for (std::size_t level = 0; level < offsets.size(); ++level) {
    out.long_word(offsets[level]);
    out.long_word(texture.levels[level].bytes.size());
    out.long_word(texture.levels[level].bytes.size());
  }
  out.block(descriptor);
  out.block(keys);
  for (std::size_t level = offsets.size(); level-- > 0;) {
    out.pad_to(offsets[level]);
    out.block(texture.levels[level].bytes);
  }
  return out.take();
}

// Microsoft, "Programming guide for DDS": DDS_HEADER with DDS_PIXELFORMAT.
std::vector<std::uint8_t> dds_bytes(const PrefilteredTexture& texture) {
  constexpr std::uint32_t caps = 0x1, height = 0x2, width = 0x4, pitch = 0x8, pixel_format = 0x1000, mips = 0x20000;
  constexpr std::uint32_t has_alpha = 0x1, is_rgb = 0x40, is_texture = 0x1000, is_complex = 0x8, has_mips = 0x400000;
  if (texture.storage != Storage::unorm8 || texture.channels != 4 || texture.layers > 0)
    throw std::logic_error("texture " + texture.name + " is not of four bytes");
  const TextureLevel& finest = texture.levels.front();
  Bytes out;
  out.text("DDS ");
  const auto words = [&](std::initializer_list<std::uint32_t> values) {
    for (const std::uint32_t value : values) out.word(value);
  };
  words({124, caps | height | width | pitch | pixel_format | mips, static_cast<std::uint32_t>(finest.height),
         static_cast<std::uint32_t>(finest.width), static_cast<std::uint32_t>(4 * finest.width), 0,
         static_cast<std::uint32_t>(texture.levels.size())});
  out.pad_to(out.size() + 44);  // reserved
  words({32, has_alpha | is_rgb, 0, 32, 0x000000FF, 0x0000FF00, 0x00FF0000, 0xFF000000});
  words({is_texture | is_complex | has_mips, 0, 0, 0, 0});
  for (const TextureLevel& level : texture.levels) out.block(level.bytes);
  return out.take();
}

}  // namespace footprint
