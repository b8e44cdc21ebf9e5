// The brightest texel, and the sum about it.
#include "renderer/scene/small_sun.hpp"

#include <fmt/format.h>

#include <cmath>

namespace footprint {
namespace {

constexpr double least_share = 0.1;
constexpr double largest_texel = 5e-4;  // steradians: 1.3 degrees a side

double radiance_of(const Image& map, int x, int y) {
  const auto texel = map.at(x, y);
  return static_cast<double>(texel[0]) + texel[1] + texel[2];
}

}  // namespace

double small_sun_share(const Environment& environment) {
  const Image& map = *environment.radiance;
  const std::vector<double> solid_angles = row_solid_angles(map.width, map.height);
  if (solid_angles[static_cast<std::size_t>(map.height / 2)] > largest_texel) return 0.0;  // no texel is a small sun
  const auto towards = [&](int x, int y) {
    return environment_direction(environment, (x + 0.5) / map.width, (y + 0.5) / map.height);
  };
  double all = 0.0, brightest = 0.0;
  glm::dvec3 sun(0.0);
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const double radiance = radiance_of(map, x, y);
      all += radiance * solid_angles[static_cast<std::size_t>(y)];
      if (radiance <= brightest) continue;
      brightest = radiance;
      sun = towards(x, y);
    }
  }
  if (!(all > 0.0)) return 0.0;
  const double cosine = std::cos(small_sun_angle);
  double near = 0.0;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      if (glm::dot(towards(x, y), sun) >= cosine)
        near += radiance_of(map, x, y) * solid_angles[static_cast<std::size_t>(y)];
    }
  }
  return near / all;
}

std::optional<std::string> small_sun_warning(const Environment& environment) {
  const double share = small_sun_share(environment);
  if (share < least_share) return {};
  return fmt::format(
      "environment {}: {:.0f}% of its light comes from within a third of a degree, which the reference samples "
      "and "
      "methods' lookups by lobes miss or smear; give that sun as a directional light for a fair comparison",
      environment.name, 100.0 * share);
}

}  // namespace footprint
