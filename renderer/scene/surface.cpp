// Finds a surface by name and calls its functions, once its resolution fits both the range and the memory.
#include "renderer/scene/surface.hpp"

#include <fmt/format.h>

#include "renderer/core/error.hpp"
#include "renderer/core/memory.hpp"
#include "renderer/core/names.hpp"

namespace footprint {
namespace {

void check_resolution(const Surface& surface, int resolution) {
  const std::string place = "surface " + surface.name;
  if (resolution < 1 || resolution > largest_surface_resolution) {
    throw Error(ErrorKind::usage, place,
                fmt::format("the resolution is {}, not within 1 to {}", resolution, largest_surface_resolution),
                "choose a value in the range");
  }
  constexpr std::uint64_t texel_bytes = 4 * sizeof(float);
  const auto side = static_cast<std::uint64_t>(resolution);
  require_memory(frame_bytes(side, side, texel_bytes),
                 fmt::format("{}: a map of {} x {} texels", place, resolution, resolution),
                 "give a smaller resolution, or free memory");
}

}  // namespace

const Surface& find_surface(std::span<const Surface> surfaces, std::string_view name) {
  std::vector<std::string> names;
  for (const Surface& surface : surfaces) names.push_back(surface.name);
  return surfaces[find_word(names, name, "surface", "surface")];
}

SurfaceSettings surface_settings(const Surface& surface, const std::map<std::string, std::string>& given) {
  return {.resolution = surface.default_resolution,
          .parameters = Options(surface.parameters, given, "surface " + surface.name)};
}

Image surface_map(const Surface& surface, const SurfaceSettings& settings,
                  Image (*Surface::*map)(const SurfaceSettings&)) {
  if (surface.*map == nullptr) return {};
  check_resolution(surface, settings.resolution);
  return (surface.*map)(settings);
}

}  // namespace footprint
