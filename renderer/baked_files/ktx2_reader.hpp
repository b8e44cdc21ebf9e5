// For tests: a reader of KTX 2.0 files by the words of the specification alone; it shares nothing with the writer.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace footprint::test {

/// A level's bytes, and how large it is.
struct Ktx2Level {
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint8_t> bytes;
};

/// What a file says.
struct Ktx2File {
  std::uint32_t vk_format = 0, type_size = 0, width = 0, height = 0, layers = 0;
  std::vector<std::uint32_t> descriptor;  ///< the words of its data format descriptor
  std::map<std::string, std::string> keys;
  std::vector<Ktx2Level> levels;  ///< finest first
};

/// Reads it and holds every rule of the specification that a file without supercompression is under. Throws
/// std::runtime_error that names the rule which is broken.
[[nodiscard]] Ktx2File read_ktx2(std::span<const std::uint8_t> bytes);

}  // namespace footprint::test
