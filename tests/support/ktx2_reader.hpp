// A reader of KTX 2.0 files, written from the specification; it shares no code with the writer.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace footprint::test {

/// A level: its size in texels and its bytes.
struct Ktx2Level {
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint8_t> bytes;
};

/// The content of a file.
struct Ktx2File {
  std::uint32_t vk_format = 0, type_size = 0, width = 0, height = 0, layers = 0;
  std::vector<std::uint32_t> descriptor;  ///< the words of its data format descriptor
  std::map<std::string, std::string> keys;
  std::vector<Ktx2Level> levels;  ///< finest first
};

/// Reads a file and checks every rule of the specification for files without supercompression. Throws
/// std::runtime_error, which names the broken rule.
[[nodiscard]] Ktx2File read_ktx2(std::span<const std::uint8_t> bytes);

}  // namespace footprint::test
