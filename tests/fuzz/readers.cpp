// The readers of what scenes are made of, and of what is baked of them.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "renderer/bake/baked_method.hpp"
#include "renderer/bake/method_file.hpp"
#include "renderer/core/bytes.hpp"
#include "renderer/image/image_io.hpp"
#include "renderer/scene/assembly/microgeometry_content.hpp"
#include "renderer/scene/environment.hpp"
#include "renderer/scene/model.hpp"
#include "renderer/scene/obj/mtl.hpp"
#include "renderer/scene/settings/scene.hpp"
#include "tests/fuzz/fuzz_target.hpp"

namespace footprint::fuzz {
namespace {

// Sizes above what one input can reasonably mean are refused by the caller's limit, as they are in the program.
constexpr int largest_side = 256;

// The checksum of a cache entry, 16 digits at its end, would keep every change from the reader.
std::vector<std::uint8_t> with_new_checksum(std::span<const std::uint8_t> bytes) {
  const std::span<const std::uint8_t> body = bytes.first(bytes.size() - std::min<std::size_t>(bytes.size(), 16));
  std::vector<std::uint8_t> out(body.begin(), body.end());
  const std::string sum = fmt::format("{:016x}", fnv1a(std::as_bytes(body)));
  out.insert(out.end(), sum.begin(), sum.end());
  return out;
}

}  // namespace

Reader reader_named(const std::string& name) {
  using Path = std::filesystem::path;
  using Bytes = std::span<const std::uint8_t>;
  if (name == "gltf") return {"input.gltf", [](const Path& file, Bytes) { static_cast<void>(load_gltf(file)); }};
  if (name == "glb") return {"input.glb", [](const Path& file, Bytes) { static_cast<void>(load_gltf(file)); }};
  if (name == "obj") return {"input.obj", [](const Path& file, Bytes) { static_cast<void>(load_obj(file)); }};
  if (name == "mtl") {
    return {"input.mtl", [](const Path& file, Bytes) {
              std::vector<std::string> warnings;
              MtlLibrary library(warnings);
              library.read(file);
              static_cast<void>(library.material("a"));
            }};
  }
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
  if (name == "method")
    return {"input.glsl", [](const Path& file, Bytes) { static_cast<void>(read_method_file(file.string())); }};
  if (name == "cache_entry")
    return {"input.bytes", [](const Path&, Bytes bytes) { static_cast<void>(from_bytes(with_new_checksum(bytes))); }};
  std::fprintf(stderr, "%s is not a reader\n", name.c_str());
  std::abort();
}

}  // namespace footprint::fuzz
