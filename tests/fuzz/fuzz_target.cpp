// The target of libFuzzer: any bytes are read by FOOTPRINT_FUZZ_READER, or end in Error; nothing else may happen. The
// sanitizers look on (scripts/fuzz).
#include "tests/fuzz/fuzz_target.hpp"

#include <unistd.h>

#include <cstddef>
#include <fstream>

#include "renderer/core/error.hpp"

namespace footprint::fuzz {
namespace {

/// A file of this process, written anew for each input, in a folder that is gone afterwards.
class InputFile {
 public:
  explicit InputFile(const char* name)
      : folder_(std::filesystem::temp_directory_path() / ("footprint_fuzz_" + std::to_string(::getpid()))),
        file_(folder_ / name) {
    std::filesystem::create_directories(folder_);
  }
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;
  ~InputFile() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  const std::filesystem::path& holding(const std::uint8_t* data, std::size_t size) const {
    std::ofstream(file_, std::ios::binary)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    return file_;
  }

 private:
  std::filesystem::path folder_, file_;
};

}  // namespace
}  // namespace footprint::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const footprint::fuzz::Reader reader = footprint::fuzz::reader_named(FOOTPRINT_FUZZ_READER);
  static const footprint::fuzz::InputFile file(reader.file_name);
  try {
    reader.read(file.holding(data, size), {data, size});
  } catch (const footprint::Error&) {
    // What a reader is to do with what it does not understand.
  }
  return 0;
}
