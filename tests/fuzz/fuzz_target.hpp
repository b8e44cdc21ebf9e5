// What a reader of foreign files is to libFuzzer: a file's name, and what reads it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace footprint::fuzz {

/// Reads bytes, or the file that holds them; ends in Error, or not at all.
using Read = void (*)(const std::filesystem::path& file, std::span<const std::uint8_t> bytes);

struct Reader {
  const char* file_name;
  Read read;
};

/// The reader that a program is made for (readers.cpp, run_readers.cpp). Aborts where there is none of that name.
[[nodiscard]] Reader reader_named(const std::string& name);

}  // namespace footprint::fuzz
