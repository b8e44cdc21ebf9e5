// Finds the cell of two directions, and fills tables from functions.
#include "renderer/microgeometry/tabulated_brdf.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace footprint {
namespace {

using std::numbers::pi;

std::size_t cell_of(double share, int cells) {
  return static_cast<std::size_t>(std::clamp(static_cast<int>(share * cells), 0, cells - 1));
}

// Cosines of both directions to the normal. wi and wo are at theta_d on opposite sides of the half vector; phi_d
// rotates their plane about it.
glm::dvec2 cosines_of(const glm::dvec3& angles) {
  const double along = std::cos(angles.x) * std::cos(angles.y);
  const double across = std::sin(angles.x) * std::sin(angles.y) * std::cos(angles.z);
  return {along - across, along + across};
}

}  // namespace

glm::vec3 TabulatedBrdf::at(double theta_h, double theta_d, double phi_d) const {
  const double turn = phi_d / pi - std::floor(phi_d / pi);
  const std::size_t h = cell_of(std::sqrt(std::max(theta_h, 0.0) / (0.5 * pi)), theta_h_cells);
  const std::size_t d = cell_of(theta_d / (0.5 * pi), theta_d_cells);
  const std::size_t p = cell_of(turn, phi_d_cells);
  return values[(h * theta_d_cells + d) * phi_d_cells + p];
}

glm::vec3 TabulatedBrdf::at(const glm::dvec3& normal, const glm::dvec3& wi, const glm::dvec3& wo) const {
  const glm::dvec3 sum = wi + wo;
  const double length = glm::length(sum);
  if (!(length > 1e-9)) return glm::vec3(0.0F);
  const glm::dvec3 h = sum / length;
  // The azimuth of a direction about the half vector relative to that of the normal.
  const glm::dvec3 up = normal - h * glm::dot(normal, h);
  const glm::dvec3 side = wi - h * glm::dot(wi, h);
  const double lengths = glm::length(up) * glm::length(side);
  const double phi = lengths > 1e-15 ? std::acos(std::clamp(-glm::dot(up, side) / lengths, -1.0, 1.0)) : 0.0;
  return at(std::atan2(glm::length(glm::cross(normal, h)), glm::dot(normal, h)),
            std::atan2(glm::length(side), glm::dot(wi, h)), phi);
}

glm::dvec3 tabulated_angles(int theta_h_cell, int theta_d_cell, int phi_d_cell) {
  const double root = (theta_h_cell + 0.5) / TabulatedBrdf::theta_h_cells;
  return {0.5 * pi * root * root, 0.5 * pi * (theta_d_cell + 0.5) / TabulatedBrdf::theta_d_cells,
          pi * (phi_d_cell + 0.5) / TabulatedBrdf::phi_d_cells};
}

TabulatedBrdf tabulate(const std::function<glm::vec3(const glm::dvec3& angles)>& brdf) {
  TabulatedBrdf table;
  table.values.reserve(TabulatedBrdf::cell_count);
  for (int h = 0; h < TabulatedBrdf::theta_h_cells; ++h) {
    for (int d = 0; d < TabulatedBrdf::theta_d_cells; ++d) {
      for (int p = 0; p < TabulatedBrdf::phi_d_cells; ++p) table.values.push_back(brdf(tabulated_angles(h, d, p)));
    }
  }
  return table;
}

TabulatedBrdf ward_brdf(const glm::vec3& diffuse, const glm::vec3& specular, double alpha) {
  return tabulate([&](const glm::dvec3& angles) {
    const glm::dvec2 cosines = cosines_of(angles);
    if (cosines.x <= 0.0 || cosines.y <= 0.0) return glm::vec3(0.0F);
    const double tangent = std::tan(angles.x) / alpha;
    const double lobe =
        std::exp(-tangent * tangent) / (4.0 * pi * alpha * alpha * std::sqrt(std::max(cosines.x * cosines.y, 1e-4)));
    return diffuse / static_cast<float>(pi) + specular * static_cast<float>(lobe);
  });
}

}  // namespace footprint
