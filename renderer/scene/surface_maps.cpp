// See surface_maps.hpp.
#include "renderer/scene/surface_maps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>

#include "renderer/core/error.hpp"

namespace footprint {
namespace {

/// NaN comes out as the lower end, which std::clamp would let through.
float unit_range(float value) { return value > 0.0F ? std::min(value, 1.0F) : 0.0F; }

}  // namespace

NormalMap decode_normal_map(const Image& stored, double scale) {
  if (stored.channels < 3) {
    throw Error(ErrorKind::usage, {}, "a normal map needs three channels, this image has fewer",
                "store the normal's x, y, z in red, green, blue");
  }
  constexpr double smallest_z = 1e-6;
  NormalMap map{Image(stored.width, stored.height, 4), 0, 0};
  for (int y = 0; y < stored.height; ++y) {
    for (int x = 0; x < stored.width; ++x) {
      const auto in = stored.at(x, y);
      const auto out = map.image.at(x, y);
      glm::dvec3 normal = 2.0 * glm::dvec3{in[0], in[1], in[2]} - 1.0;
      const double length = glm::length(normal);
      if (!std::isfinite(length) || length < 1e-3) {
        ++map.invalid;
        std::ranges::copy(std::array{0.0F, 0.0F, 1.0F, 0.0F}, out.begin());
        continue;
      }
      if (normal.z <= 0.0) {
        ++map.inverted;
        normal.z = smallest_z;
      }
      normal = glm::normalize(normal * glm::dvec3{scale, scale, 1.0});
      std::ranges::copy(
          std::array{static_cast<float>(normal.x), static_cast<float>(normal.y), static_cast<float>(normal.z), 1.0F},
          out.begin());
    }
  }
  return map;
}

std::vector<std::string> describe_faults(const NormalMap& map, const std::string& name) {
  std::vector<std::string> lines;
  if (map.invalid > 0) {
    lines.push_back(fmt::format("normal map `{}`: {} texels hold no direction and do not count", name, map.invalid));
  }
  if (map.inverted > 0) {
    lines.push_back(
        fmt::format("normal map `{}`: {} texels point into the surface and are laid flat on it", name, map.inverted));
  }
  return lines;
}

Image decode_metallic_roughness(const Image& stored, float roughness_factor, float metallic_factor) {
  const bool color = stored.channels >= 3;
  Image map(stored.width, stored.height, 2);
  for (int y = 0; y < stored.height; ++y) {
    for (int x = 0; x < stored.width; ++x) {
      const auto in = stored.at(x, y);
      map.at(x, y)[0] = roughness_factor * unit_range(in[color ? 1 : 0]);
      map.at(x, y)[1] = metallic_factor * unit_range(in[color ? 2 : 0]);
    }
  }
  return map;
}

Image to_rgba(const Image& stored) {
  const bool color = stored.channels >= 3;
  const bool alpha = stored.channels % 2 == 0;
  Image map(stored.width, stored.height, 4, 1.0F);
  for (int y = 0; y < stored.height; ++y) {
    for (int x = 0; x < stored.width; ++x) {
      const auto in = stored.at(x, y);
      const auto out = map.at(x, y);
      for (std::size_t c = 0; c < 3; ++c) out[c] = unit_range(in[color ? c : 0]);
      if (alpha) out[3] = unit_range(in.back());
    }
  }
  return map;
}

}  // namespace footprint
