// Asks for existence, kind and size before it opens a file, then reads it at once.
#include "renderer/core/file_bytes.hpp"

#include <fmt/format.h>

#include <fstream>
#include <system_error>

#include "renderer/core/error.hpp"

namespace footprint {

std::vector<std::uint8_t> read_file_bytes(const std::filesystem::path& file, std::uint64_t largest) {
  const auto fail = [&](const std::string& message, const std::string& hint) {
    return Error(ErrorKind::usage, file.string(), message, hint);
  };
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) throw fail("no such file", "check the path");
  // A device such as /dev/zero has no end, a pipe may never give one.
  if (!std::filesystem::is_regular_file(status)) throw fail("not a regular file", "name a file");
  const auto size = std::filesystem::file_size(file, error);
  if (error) throw fail("cannot be read: " + error.message(), "check the permissions");
  if (size == 0) throw fail("the file is empty", "give the whole file");
  if (size > largest) {
    throw fail(fmt::format("{} bytes, more than the {} that are read", size, largest), "make the file smaller");
  }
  std::vector<std::uint8_t> bytes(size);
  std::ifstream stream(file, std::ios::binary);
  if (!stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size))) {
    throw fail("cannot be read", "check the permissions");
  }
  return bytes;
}

}  // namespace footprint
