// PNG files byte by byte, also files that no encoder writes.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace footprint::test {

/// Colour types of the PNG specification, table 11.1.
enum class PngColor : std::uint8_t { gray = 0, rgb = 2, palette = 3, gray_alpha = 4, rgba = 6 };

inline std::string big_endian(std::uint32_t value) {
  return {static_cast<char>(value >> 24), static_cast<char>(value >> 16), static_cast<char>(value >> 8),
          static_cast<char>(value)};
}

/// One chunk with a correct CRC (PNG specification, annex D).
inline std::string png_chunk(std::string_view type, std::string_view data) {
  const std::string body = std::string(type) + std::string(data);
  std::uint32_t crc = 0xffffffffU;
  for (const char byte : body) {
    crc ^= static_cast<std::uint8_t>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1U) != 0 ? 0xedb88320U : 0U);
  }
  return big_endian(static_cast<std::uint32_t>(data.size())) + body + big_endian(~crc);
}

/// A zlib stream (RFC 1950) of one stored block of at most 65535 bytes.
inline std::string stored_zlib(std::string_view data) {
  std::uint32_t a = 1, b = 0;
  for (const char byte : data) {
    a = (a + static_cast<std::uint8_t>(byte)) % 65521;
    b = (b + a) % 65521;
  }
  const auto length = static_cast<std::uint16_t>(data.size());
  const auto inverse = static_cast<std::uint16_t>(~length);
  std::string stream{'\x78', '\x01', '\x01'};
  for (const std::uint16_t word : {length, inverse}) {
    stream += static_cast<char>(word & 0xff);
    stream += static_cast<char>(word >> 8);
  }
  return stream.append(data) + big_endian((b << 16) | a);
}

/// A whole file. `rows` are the raw bytes, each row after its filter byte 0; `extra` are chunks before the data.
inline std::vector<std::uint8_t> png_file(std::uint32_t width, std::uint32_t height, int depth, PngColor color,
                                          std::string_view rows, const std::string& extra = {}) {
  const std::string header = big_endian(width) + big_endian(height) + static_cast<char>(depth) +
                             static_cast<char>(color) + std::string(3, '\0');
  const std::string file = "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", header) + extra +
                           png_chunk("IDAT", stored_zlib(rows)) + png_chunk("IEND", {});
  return {file.begin(), file.end()};
}

}  // namespace footprint::test
