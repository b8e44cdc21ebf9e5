// A libFuzzer target for each reader of foreign files, FOOTPRINT_FUZZ_READER of them in one program: any bytes are
// read, or end in Error; nothing else may happen. The sanitizers look on (scripts/fuzz).
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <vector>

#include "renderer/bake/prefiltered_file.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/hash.hpp"
#include "renderer/image/image_io.hpp"
#include "renderer/scene/environment.hpp"
#include "renderer/scene/gltf/model.hpp"
#include "renderer/scene/merl_file.hpp"
#include "renderer/scene/obj_model.hpp"
#include "renderer/scene/settings/scene.hpp"
#include "results/report/listed_files.hpp"

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

using Read = void (*)(const std::filesystem::path& file, std::span<const std::uint8_t> bytes);
struct Reader {
  const char* file_name;
  Read read;
};

// Sizes above what one input can reasonably mean are refused by the caller's limit, as they are in the program.
constexpr int largest_side = 256;

// The checksum of a cache entry, 16 digits at its end, would keep every change from the reader.
std::vector<std::uint8_t> sealed_anew(std::span<const std::uint8_t> bytes) {
  const std::span<const std::uint8_t> body = bytes.first(bytes.size() - std::min<std::size_t>(bytes.size(), 16));
  ContentHash hash;
  hash.add(std::as_bytes(body));
  std::vector<std::uint8_t> out(body.begin(), body.end());
  const std::string sum = hash.hex();
  out.insert(out.end(), sum.begin(), sum.end());
  return out;
}

Reader reader_named(const std::string& name) {
  using Path = std::filesystem::path;
  using Bytes = std::span<const std::uint8_t>;
  if (name == "gltf") return {"input.gltf", [](const Path& file, Bytes) { static_cast<void>(load_gltf(file)); }};
  if (name == "glb") return {"input.glb", [](const Path& file, Bytes) { static_cast<void>(load_gltf(file)); }};
  if (name == "obj") return {"input.obj", [](const Path& file, Bytes) { static_cast<void>(load_obj(file)); }};
  if (name == "merl") return {"input.binary", [](const Path& file, Bytes) { static_cast<void>(read_merl(file)); }};
  if (name == "picture")
    return {"input.bytes", [](const Path&, Bytes bytes) {
              static_cast<void>(read_image(bytes, "input", Transfer::linear, largest_side));
            }};
  if (name == "environment")
    return {"input.hdr", [](const Path& file, Bytes) {
              std::vector<std::string> warnings;
              static_cast<void>(load_environment(file, warnings));
            }};
  if (name == "scene")
    return {"scene.toml", [](const Path& file, Bytes) { static_cast<void>(read_scene_settings(file, {})); }};
  if (name == "cache_entry")
    return {"input.bytes", [](const Path&, Bytes bytes) { static_cast<void>(from_bytes(sealed_anew(bytes))); }};
  if (name == "results")
    return {"results.json", [](const Path& file, Bytes) { static_cast<void>(listed_files(file)); }};
  std::fprintf(stderr, "there is no reader %s\n", name.c_str());
  std::abort();
}

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
