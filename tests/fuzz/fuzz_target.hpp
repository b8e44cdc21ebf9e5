// A reader of foreign files for libFuzzer: a file's name, and its reading function.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace footprint::fuzz {

/// Reads bytes, or the file with them; ends in Error, or succeeds.
using Read = void (*)(const std::filesystem::path& file, std::span<const std::uint8_t> bytes);

struct Reader {
  const char* file_name;
  Read read;
};

/// The reader that a program is made for (readers.cpp, run_readers.cpp). Aborts where there is none of that name.
[[nodiscard]] Reader reader_named(const std::string& name);

}  // namespace footprint::fuzz
