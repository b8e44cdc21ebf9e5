// Settings come first, then the scene's own.
#include "experiments/studies/frame_setup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "renderer/core/error.hpp"
#include "renderer/core/memory.hpp"

namespace footprint {
namespace {

constexpr int default_width = 512;
constexpr float highest_default = 1 << 20;  // of a camera narrower than a hair
constexpr std::uint64_t pixel_bytes = 16;   // RGBA, 32-bit floats

}  // namespace

glm::ivec2 frame_size(const Scene& scene, const std::optional<glm::ivec2>& wanted) {
  glm::ivec2 size(default_width, default_width);
  if (scene.camera.aspect) {
    size.y = static_cast<int>(std::lround(std::clamp(default_width / *scene.camera.aspect, 1.0F, highest_default)));
  }
  if (scene.frame_size) size = *scene.frame_size;
  if (wanted) size = *wanted;
  if (size.x < 1 || size.y < 1) {
    throw Error(ErrorKind::usage, "--size", fmt::format("{}x{} has no pixel", size.x, size.y), "give at least 1x1");
  }
  return size;
}

FootprintFilter footprint_filter_of(const std::optional<FootprintFilter>& given, const Scene& scene) {
  return given.value_or(scene.footprint.value_or(default_footprint_filter));
}

ShaderVariant frame_program(const Scene& scene, const FootprintFilter& filter) {
  return {.footprint = filter, .orthographic = scene.camera.orthographic};
}

void require_pictures(const glm::ivec2& size, int count) {
  const std::uint64_t bytes = frame_bytes(static_cast<std::uint64_t>(size.x), static_cast<std::uint64_t>(size.y),
                                          pixel_bytes * static_cast<std::uint64_t>(count));
  require_memory(bytes, fmt::format("{} images of {}x{}", count, size.x, size.y));
}

}  // namespace footprint
