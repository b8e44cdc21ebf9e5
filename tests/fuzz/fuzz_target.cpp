// The target of libFuzzer: any bytes are read by FOOTPRINT_FUZZ_READER, or end in Error; nothing else may happen. The
// sanitizers look on (scripts/fuzz).
#include "tests/fuzz/fuzz_target.hpp"

#include <cstddef>
#include <fstream>

#include "renderer/core/error.hpp"
#include "tests/support/fresh_folder.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const footprint::fuzz::Reader reader = footprint::fuzz::reader_named(FOOTPRINT_FUZZ_READER);
  static const std::filesystem::path file = footprint::test::process_folder() / reader.file_name;
  std::ofstream(file, std::ios::binary).write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  try {
    reader.read(file, {data, size});
  } catch (const footprint::Error&) {
    // The right answer of a reader to malformed input.
  }
  return 0;
}
