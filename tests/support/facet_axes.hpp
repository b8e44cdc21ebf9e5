// For tests: normals, and axes that turn with them.
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <vector>

namespace footprint::testing {

/// Normals over the whole sphere, near both poles too.
[[nodiscard]] inline std::vector<glm::dvec3> sphere_normals() {
  std::vector<glm::dvec3> out{{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, -1, 0}};
  for (const double theta : {1e-6, 1e-3, 0.4, 1.2, 1.57, 1.6, 2.5, std::numbers::pi - 1e-3, std::numbers::pi - 1e-6}) {
    for (const double phi : {0.0, 0.7, 2.0, 4.4})
      out.emplace_back(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
  }
  return out;
}

/// Unit vectors above the horizon.
[[nodiscard]] inline std::vector<glm::dvec3> facet_axes() {
  return {{0, 0, 1}, glm::normalize(glm::dvec3(1, 0, 1)), glm::normalize(glm::dvec3(-0.3, 0.8, 0.2))};
}

}  // namespace footprint::testing
