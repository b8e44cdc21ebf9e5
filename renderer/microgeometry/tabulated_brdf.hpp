// An isotropic BRDF tabulated over half and difference angles, the format of measured BRDFs (Matusik et al. 2003).
#pragma once

#include <cstddef>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

namespace footprint {

/// RGB values over (theta_h, theta_d, phi_d) in the cells of the MERL database. Cells are even in the square root of
/// theta_h, which makes them narrow near the specular direction, and even in theta_d and phi_d (angles: Rusinkiewicz
/// 1998).
struct TabulatedBrdf {
  static constexpr int theta_h_cells = 90, theta_d_cells = 90, phi_d_cells = 180;
  static constexpr std::size_t cell_count = std::size_t{theta_h_cells} * theta_d_cells * phi_d_cells;

  std::vector<glm::vec3> values;  ///< 1/sr, >= 0; theta_h slowest, phi_d fastest

  /// The value at three angles in radians: theta_h and theta_d in 0..pi/2, phi_d with period pi. No interpolation.
  [[nodiscard]] glm::vec3 at(double theta_h, double theta_d, double phi_d) const;

  /// The value for two unit directions above the horizon of a unit normal.
  [[nodiscard]] glm::vec3 at(const glm::dvec3& normal, const glm::dvec3& wi, const glm::dvec3& wo) const;
};

/// The angles theta_h, theta_d, phi_d of the centre of a cell.
[[nodiscard]] glm::dvec3 tabulated_angles(int theta_h_cell, int theta_d_cell, int phi_d_cell);

/// Tabulates a function of the three angles.
[[nodiscard]] TabulatedBrdf tabulate(const std::function<glm::vec3(const glm::dvec3& angles)>& brdf);

/// Ward's isotropic BRDF (1992): diffuse / pi + specular e^{-tan^2(theta_h) / alpha^2} / (4 pi alpha^2 sqrt(cos cos)).
[[nodiscard]] TabulatedBrdf ward_brdf(const glm::vec3& diffuse, const glm::vec3& specular, double alpha);

}  // namespace footprint
