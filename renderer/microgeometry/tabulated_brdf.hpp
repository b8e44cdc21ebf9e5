// An isotropic BRDF as a table over half and difference angles, as measured ones come (Matusik et al. 2003).
#pragma once

#include <cstddef>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

namespace footprint {

/// f(theta_h, theta_d, phi_d) in RGB, in the cells of the MERL database: theta_h by its root (narrow cells near the
/// specular direction), theta_d and phi_d evenly (Rusinkiewicz 1998 names the angles).
struct TabulatedBrdf {
  static constexpr int theta_h_cells = 90, theta_d_cells = 90, phi_d_cells = 180;
  static constexpr std::size_t cell_count = std::size_t{theta_h_cells} * theta_d_cells * phi_d_cells;

  std::vector<glm::vec3> values;  ///< 1/sr, >= 0; theta_h slowest, phi_d fastest

  /// The value of the cell that three angles (radians) fall in: theta 0..pi/2; phi_d any, of period pi.
  [[nodiscard]] glm::vec3 at(double theta_h, double theta_d, double phi_d) const;

  /// The value for two unit vectors about a unit normal, both above its horizon.
  [[nodiscard]] glm::vec3 at(const glm::dvec3& normal, const glm::dvec3& wi, const glm::dvec3& wo) const;
};

/// The angles of a cell's centre: theta_h, theta_d, phi_d.
[[nodiscard]] glm::dvec3 tabulated_angles(int theta_h_cell, int theta_d_cell, int phi_d_cell);

/// A table of a function of the three angles.
[[nodiscard]] TabulatedBrdf tabulate(const std::function<glm::vec3(const glm::dvec3& angles)>& brdf);

/// Ward's isotropic BRDF (1992): diffuse / pi + specular e^{-tan^2(theta_h) / alpha^2} / (4 pi alpha^2 sqrt(cos cos)).
[[nodiscard]] TabulatedBrdf ward_brdf(const glm::vec3& diffuse, const glm::vec3& specular, double alpha);

}  // namespace footprint
