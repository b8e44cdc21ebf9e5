// The inputs of properties: numbers over many decades, directions, maps. All are made of whole numbers, by which
// RapidCheck shrinks a counter-example.
#pragma once

#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

#include "renderer/image/image.hpp"

namespace footprint::testing {

inline constexpr int steps = 1'000'000;

/// A number in [least, most], evenly.
inline double number(double least, double most) {
  return least + (most - least) * *rc::gen::inRange(0, steps + 1) / steps;
}

/// A number in [least, most], every decade alike; least above 0.
inline double magnitude(double least, double most) { return std::exp(number(std::log(least), std::log(most))); }

/// A unit vector anywhere on the sphere, the poles and the horizon among them.
inline glm::dvec3 direction() {
  const double z = *rc::gen::weightedElement<int>({{8, 0}, {1, 1}, {1, 2}, {1, 3}}) == 0
                       ? number(-1.0, 1.0)
                       : *rc::gen::element(-1.0, 0.0, 1.0, 1e-7);
  const double azimuth = number(0.0, 2.0 * std::numbers::pi);
  const double r = std::sqrt(std::max(0.0, 1.0 - z * z));
  return {r * std::cos(azimuth), r * std::sin(azimuth), z};
}

/// A unit vector no lower than the horizon.
inline glm::dvec3 upper_direction() {
  const glm::dvec3 d = direction();
  return {d.x, d.y, std::abs(d.z)};
}

/// A map of any small size, of normals above the horizon with weight 1; of every `1 / invalid` texels one has none.
inline Image normal_map(double invalid = 0.0) {
  Image map(*rc::gen::inRange(1, 14), *rc::gen::inRange(1, 14), 4);
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const auto texel = map.at(x, y);
      if (number(0.0, 1.0) > 1.0 - invalid) continue;
      const glm::dvec3 n = upper_direction();
      texel[0] = static_cast<float>(n.x);
      texel[1] = static_cast<float>(n.y);
      texel[2] = static_cast<float>(n.z);
      texel[3] = 1.0F;
    }
  }
  return map;
}

}  // namespace footprint::testing
