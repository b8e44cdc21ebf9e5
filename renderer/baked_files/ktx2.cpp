// The parts of the file in their order, written and read; sections and tables are those of the KTX 2.0 specification
// and, for the data format descriptor, of the Khronos Data Format Specification 1.3. Debian 12 has no library for KTX.
#include "renderer/baked_files/baked_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <span>
#include <stdexcept>
#include <string_view>

#include "renderer/core/bytes.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/memory.hpp"

namespace footprint {
namespace {

constexpr std::array<std::uint8_t, 12> identifier{0xAB, 'K', 'T', 'X', ' ', '2', '0', 0xBB, '\r', '\n', 0x1A, '\n'};
constexpr std::size_t header_bytes = 80;       // identifier, nine words, and the index of four words and two long ones
constexpr std::size_t level_entry_bytes = 24;  // offset, length, uncompressed length
constexpr std::uint32_t block_version = 2;     // of a basic descriptor block: KDFS 1.3
constexpr std::uint32_t primaries_unspecified = 0, transfer_linear = 1;
constexpr std::uint32_t type_signed_float = 0xC0;  // qualifiers of a channel: float and signed

using Bytes = std::vector<std::uint8_t>;

void append(Bytes& out, std::initializer_list<std::size_t> words) {
  for (const std::size_t word : words) {
    for (int i = 0; i < 4; ++i) out.push_back(static_cast<std::uint8_t>(word >> (8 * i)));
  }
}

void append_long(Bytes& out, std::uint64_t value) { append(out, {value & 0xFFFFFFFFU, value >> 32U}); }

void append(Bytes& out, const auto& bytes) { out.insert(out.end(), bytes.begin(), bytes.end()); }

// The bytes of a texel, or of a block.
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
Bytes format_descriptor(const PrefilteredTexture& texture) {
  const std::vector<Sample> samples = samples_of(texture);
  const std::size_t block_size = 24 + 16 * samples.size();
  const std::size_t block = is_block(texture.storage) ? 3 | 3 << 8 : 0;  // texels of 4 x 4 x 1 x 1, or one
  Bytes out;
  append(out, {4 + block_size, 0, block_version | block_size << 16});
  append(out, {color_model(texture.storage) | primaries_unspecified << 8 | transfer_linear << 16, block});
  append(out, {texel_size(texture), 0});  // bytes of plane 0 and of the others
  for (const Sample& sample : samples)    // the second word: its place in the block
    append(out, {sample.offset | sample.last_bit << 16 | sample.channel << 24, 0, sample.lower, sample.upper});
  return out;
}

// In the order of the keys, each with its length in front and filled up to four bytes.
Bytes key_values() {
  using namespace std::string_view_literals;
  Bytes out;
  for (const std::string_view entry : {"KTXorientation\0rd\0"sv, "KTXwriter\0footprint bake\0"sv}) {
    append(out, {entry.size()});
    append(out, entry);
    out.resize(rounded_up(out.size(), 4));
  }
  return out;
}

// The offset of each level's bytes, `first` being the first free byte: the coarsest comes first.
std::vector<std::size_t> level_offsets(const PrefilteredTexture& texture, std::size_t first) {
  const std::size_t step = std::lcm(texel_size(texture), std::size_t{4});
  std::vector<std::size_t> offsets(texture.levels.size());
  for (std::size_t level = offsets.size(); level-- > 0;) {
    offsets[level] = rounded_up(first, step);
    first = offsets[level] + texture.levels[level].bytes.size();
  }
  return offsets;
}

// The unit of byte order.
std::size_t type_size(Storage storage) { return is_block(storage) ? 1 : channel_bytes(storage); }

[[noreturn]] void refuse(const std::string& message) {
  throw Error(ErrorKind::usage, {}, message,
              "write 2D textures as `footprint bake` does, without supercompression, or bake the map again");
}

// A part of a file that was checked to be within it.
Bytes part_of(const ByteSource& file, std::uint64_t from, std::uint64_t length, std::string_view what) {
  if (from > file.size() || length > file.size() - from)
    refuse(fmt::format("{} is beyond the end of the file ({} bytes)", what, file.size()));
  Bytes bytes(static_cast<std::size_t>(length));
  if (!file.read(from, bytes)) throw Error(ErrorKind::machine, {}, "cannot be read", "check the disk");
  return bytes;
}

std::uint32_t word_at(const Bytes& bytes, std::size_t at) {
  std::uint32_t word = 0;
  for (std::size_t i = 4; i-- > 0;) word = word << 8U | bytes.at(at + i);
  return word;
}

std::uint64_t long_at(const Bytes& bytes, std::size_t at) {
  return word_at(bytes, at) | std::uint64_t{word_at(bytes, at + 4)} << 32U;
}

void require_equal(std::string_view what, std::uint64_t found, std::uint64_t expected) {
  if (found != expected) refuse(fmt::format("its {} is {}, and {} was expected", what, found, expected));
}

void require_header(const Bytes& head, const PrefilteredTexture& form) {
  if (!std::ranges::equal(std::span(head).first(identifier.size()), identifier)) refuse("is not a KTX2 file");
  const TextureLevel& finest = form.levels.front();
  require_equal("vkFormat", word_at(head, 12), vk_format(form.storage, form.channels));
  require_equal("typeSize", word_at(head, 16), type_size(form.storage));
  require_equal("pixelWidth", word_at(head, 20), static_cast<std::uint64_t>(finest.width));
  require_equal("pixelHeight", word_at(head, 24), static_cast<std::uint64_t>(finest.height));
  require_equal("pixelDepth", word_at(head, 28), 0);
  require_equal("layerCount", word_at(head, 32), static_cast<std::uint64_t>(form.layers));
  require_equal("faceCount", word_at(head, 36), 1);
  require_equal("levelCount", word_at(head, 40), form.levels.size());
  require_equal("supercompressionScheme", word_at(head, 44), 0);
}

// Compares what decides how texels are read. Primaries, qualifiers and ranges of channels describe colours alone.
void require_descriptor(const ByteSource& file, const Bytes& head, const PrefilteredTexture& form) {
  constexpr std::uint32_t but_primaries = 0x00FF00FF, dimensions = 0xFFFFFFFF, first_plane = 0x000000FF;
  constexpr std::size_t basic_bytes = 28, model_at = 12, block_at = 16, plane_at = 20;
  const std::uint32_t length = word_at(head, 52);
  if (length < basic_bytes) refuse("its data format descriptor is cut off");
  const Bytes found = part_of(file, word_at(head, 48), basic_bytes, "its data format descriptor");
  const Bytes own = format_descriptor(form);
  require_equal("dfdTotalSize", word_at(found, 0), length);
  const auto require_word = [&](std::string_view what, std::size_t at, std::uint32_t mask) {
    require_equal(what, word_at(found, at) & mask, word_at(own, at) & mask);
  };
  require_word("colour model or transfer function", model_at, but_primaries);
  require_word("texel block", block_at, dimensions);
  require_word("bytesPlane0", plane_at, first_plane);
}

// The first byte of a level, all of whose bytes are in the file.
std::uint64_t level_offset(const ByteSource& file, const Bytes& head, const PrefilteredTexture& form,
                           std::size_t level) {
  const std::size_t entry = header_bytes + level_entry_bytes * level;
  const TextureLevel& size = form.levels[level];
  const std::uint64_t offset = long_at(head, entry), length = long_at(head, entry + 8),
                      expected = level_bytes(form.storage, form.channels, size.width, size.height) *
                                 static_cast<std::uint64_t>(std::max(form.layers, 1));
  require_equal(fmt::format("byteLength of level {}", level), length, expected);
  require_equal(fmt::format("uncompressedByteLength of level {}", level), long_at(head, entry + 16), expected);
  if (offset > file.size() || length > file.size() - offset)
    refuse(fmt::format("level {} is beyond the end of the file ({} bytes)", level, file.size()));
  return offset;
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
  const Bytes descriptor = format_descriptor(texture), keys = key_values();
  const std::size_t descriptor_at = header_bytes + level_entry_bytes * texture.levels.size();
  const std::size_t keys_at = descriptor_at + descriptor.size();
  const std::vector<std::size_t> offsets = level_offsets(texture, keys_at + keys.size());
  const auto width = static_cast<std::size_t>(texture.levels.front().width),
             height = static_cast<std::size_t>(texture.levels.front().height),
             layers = static_cast<std::size_t>(texture.layers);
  Bytes out(identifier.begin(), identifier.end());
  // After the size no depth; after the layers one face; after the levels no supercompression, and so no global data.
  append(out, {vk_format(texture.storage, texture.channels), type_size(texture.storage), width, height, 0, layers, 1,
               offsets.size(), 0});
  append(out, {descriptor_at, descriptor.size(), keys_at, keys.size(), 0, 0, 0, 0});
  for (std::size_t level = 0; level < offsets.size(); ++level) {
    for (const std::uint64_t value :
         {offsets[level], texture.levels[level].bytes.size(), texture.levels[level].bytes.size()})
      append_long(out, value);
  }
  append(out, descriptor);
  append(out, keys);
  for (std::size_t level = offsets.size(); level-- > 0;) {
    out.resize(offsets[level]);
    append(out, texture.levels[level].bytes);
  }
  return out;
}

std::vector<std::uint64_t> ktx2_offsets(const ByteSource& file, const PrefilteredTexture& form) {
  const Bytes head = part_of(file, 0, header_bytes + level_entry_bytes * form.levels.size(), "its header");
  require_header(head, form);
  require_descriptor(file, head, form);
  std::vector<std::uint64_t> offsets;
  for (std::size_t level = 0; level < form.levels.size(); ++level)
    offsets.push_back(level_offset(file, head, form, level));
  return offsets;
}

void read_ktx2(const ByteSource& file, PrefilteredTexture& texture) {
  const std::vector<std::uint64_t> offsets = ktx2_offsets(file, texture);
  const TextureLevel& finest = texture.levels.front();
  require_texels(finest.width, finest.height, byte_count(texture), "texture " + texture.name);
  for (std::size_t level = 0; level < offsets.size(); ++level) {
    TextureLevel& into = texture.levels[level];
    const std::uint64_t layer = level_bytes(texture.storage, texture.channels, into.width, into.height);
    into.bytes = part_of(file, offsets[level], layer * static_cast<std::uint64_t>(std::max(texture.layers, 1)),
                         fmt::format("level {}", level));
  }
}

// Microsoft, "Programming guide for DDS": DDS_HEADER with DDS_PIXELFORMAT.
std::vector<std::uint8_t> dds_bytes(const PrefilteredTexture& texture) {
  constexpr std::size_t caps = 0x1, has_height = 0x2, has_width = 0x4, pitch = 0x8, format = 0x1000, mips = 0x20000;
  constexpr std::size_t has_alpha = 0x1, is_rgb = 0x40, is_texture = 0x1000, is_complex = 0x8, has_mips = 0x400000;
  if (texture.storage != Storage::unorm8 || texture.channels != 4 || texture.layers > 0)
    throw std::logic_error("texture " + texture.name + " is not of four bytes");
  const auto width = static_cast<std::size_t>(texture.levels.front().width),
             height = static_cast<std::size_t>(texture.levels.front().height);
  Bytes out;
  append(out, std::string_view("DDS "));
  append(out, {124, caps | has_height | has_width | pitch | format | mips, height, width, 4 * width, 0,
               texture.levels.size()});
  out.resize(out.size() + 44);  // reserved
  append(out, {32, has_alpha | is_rgb, 0, 32, 0x000000FF, 0x0000FF00, 0x00FF0000, 0xFF000000});
  append(out, {is_texture | is_complex | has_mips, 0, 0, 0, 0});
  for (const TextureLevel& level : texture.levels) append(out, level.bytes);
  return out;
}

}  // namespace footprint
