// Section numbers are those of the KTX 2.0 specification; KDFS is the Khronos Data Format Specification 1.3.
#include "tests/support/ktx2_reader.hpp"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <stdexcept>

namespace footprint::test {
namespace {

void require(bool condition, const std::string& rule) {
  if (!condition) throw std::runtime_error(rule);
}

class Source {
 public:
  explicit Source(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  [[nodiscard]] std::uint64_t at(std::uint64_t offset, std::size_t count) const {
    const auto part = range(offset, count);
    std::uint64_t value = 0;
    for (std::size_t i = part.size(); i-- > 0;) value = value << 8U | part[i];
    return value;
  }
  [[nodiscard]] std::uint32_t word(std::uint64_t offset) const { return static_cast<std::uint32_t>(at(offset, 4)); }
  [[nodiscard]] std::span<const std::uint8_t> range(std::uint64_t offset, std::uint64_t length) const {
    require(offset <= bytes_.size() && length <= bytes_.size() - offset, "a part is beyond the end of the file");
    return bytes_.subspan(offset, length);
  }

 private:
  std::span<const std::uint8_t> bytes_;
};

// Section 3.12: keys are unique, sorted by code point, each entry filled up to four bytes with zeros.
std::map<std::string, std::string> read_keys(const Source& source, std::uint64_t at, std::uint64_t length) {
  std::map<std::string, std::string> keys;
  std::string before;
  const std::uint64_t end = at + length;
  while (at < end) {
    const std::uint32_t size = source.word(at);
    const auto entry = source.range(at + 4, size);
    const auto zero = std::ranges::find(entry, 0);
    require(zero != entry.end(), "a key ends with NUL");
    const std::string key(entry.begin(), zero);
    require(before < key, "keys are sorted and unique");
    keys[key] = std::string(zero + 1, entry.end());
    before = key;
    const std::uint32_t padding = 3 - ((size + 3) % 4);
    for (const std::uint8_t byte : source.range(at + 4 + size, padding)) require(byte == 0, "padding is zero");
    at += 4 + size + padding;
  }
  require(at == end, "the keys fill their length");
  return keys;
}

// KDFS 5: the basic descriptor block, by its declared sizes.
std::vector<std::uint32_t> read_descriptor(const Source& source, std::uint64_t at, std::uint64_t length) {
  require(length % 4 == 0 && length >= 28, "the descriptor is of words");
  std::vector<std::uint32_t> words;
  for (std::uint64_t i = 0; i < length; i += 4) words.push_back(source.word(at + i));
  require(words[0] == length, "dfdTotalSize is dfdByteLength");
  require(words[2] >> 16U == length - 4, "descriptorBlockSize is the rest");
  require((words[2] & 0xFFFFU) == 2, "the version is that of KDFS 1.3");
  return words;
}

// KDFS 5.5, texelBlockDimension: width and height of a block, minus 1; bytesPlane0: its bytes.
std::uint64_t texel_bytes(const std::vector<std::uint32_t>& descriptor) { return descriptor[5] & 0xFFU; }

std::uint64_t block_count(const std::vector<std::uint32_t>& descriptor, std::uint32_t width, std::uint32_t height) {
  const std::uint32_t w = (descriptor[4] & 0xFFU) + 1, h = (descriptor[4] >> 8U & 0xFFU) + 1;
  return std::uint64_t{(width + w - 1) / w} * ((height + h - 1) / h);
}

// Section 3.9.7, mipPadding: a level begins at a multiple of lcm(texel block size, 4); the coarsest comes first.
std::vector<Ktx2Level> read_levels(const Source& source, const Ktx2File& file, std::uint32_t count,
                                   std::uint64_t first_free) {
  std::vector<Ktx2Level> levels(count);
  const std::uint64_t texel = texel_bytes(file.descriptor);
  for (std::uint32_t level = count; level-- > 0;) {
    const std::uint64_t entry = 80 + 24 * std::uint64_t{level};
    const std::uint64_t offset = source.at(entry, 8), length = source.at(entry + 8, 8);
    levels[level].width = std::max(file.width >> level, 1U);
    levels[level].height = std::max(file.height >> level, 1U);
    require(source.at(entry + 16, 8) == length, "without supercompression both lengths are the same");
    require(length == texel * block_count(file.descriptor, levels[level].width, levels[level].height) *
                          std::max(file.layers, 1U),
            "a level has all of its texels");
    require(offset % std::lcm(texel, std::uint64_t{4}) == 0, "a level begins where its alignment allows");
    require(offset >= first_free && offset - first_free < std::lcm(texel, std::uint64_t{4}),
            "a level follows the one before without a gap");
    const auto bytes = source.range(offset, length);
    levels[level].bytes.assign(bytes.begin(), bytes.end());
    first_free = offset + length;
  }
  return levels;
}

}  // namespace

Ktx2File read_ktx2(std::span<const std::uint8_t> bytes) {
  const Source source(bytes);
  constexpr unsigned char identifier[12] = {0xAB, 0x4B, 0x54, 0x58, 0x20, 0x32, 0x30, 0xBB, 0x0D, 0x0A, 0x1A, 0x0A};
  require(std::memcmp(source.range(0, 12).data(), identifier, 12) == 0, "the identifier");
  Ktx2File file{.vk_format = source.word(12),
                .type_size = source.word(16),
                .width = source.word(20),
                .height = source.word(24),
                .layers = source.word(32),
                .descriptor = {},
                .keys = {},
                .levels = {}};
  require(source.word(28) == 0, "a 2D texture has no depth");
  require(source.word(36) == 1, "one face");
  const std::uint32_t count = source.word(40);
  std::uint32_t most = 1;
  while ((std::max(file.width, file.height) >> most) != 0) ++most;
  require(count >= 1 && count <= most, "no more levels than sizes");
  require(source.word(44) == 0, "no supercompression");
  const std::uint64_t dfd_at = source.word(48), dfd_length = source.word(52), kvd_at = source.word(56),
                      kvd_length = source.word(60);
  require(source.at(64, 8) == 0 && source.at(72, 8) == 0, "no global data without supercompression");
  require(dfd_at == 80 + 24 * std::uint64_t{count}, "the descriptor follows the level index");
  require(kvd_at == dfd_at + dfd_length, "the keys follow the descriptor");
  file.descriptor = read_descriptor(source, dfd_at, dfd_length);
  file.keys = read_keys(source, kvd_at, kvd_length);
  file.levels = read_levels(source, file, count, kvd_at + kvd_length);
  return file;
}

}  // namespace footprint::test
