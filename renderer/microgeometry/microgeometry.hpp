// The small-scale geometry of a material: a patch with a base BRDF of its facets, which may be tabulated.
#pragma once

#include <cstddef>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "renderer/image/image.hpp"
#include "renderer/microgeometry/patch.hpp"

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

/// The microgeometry of a material. The base colour of the material includes the patch's mean colour, so that methods
/// without facet colours have the right mean.
struct Microgeometry {
  Patch patch;
  glm::vec3 mean_color{1.0F};  ///< mean colour seen from directly above
  std::shared_ptr<const TabulatedBrdf>
      brdf{};  ///< of the facets, including diffuse light; null: the BRDF of the material
};

/// Whether facets need separate colours: there are several paints, or one that the base colour omits because the BRDF
/// of the facets is tabulated.
[[nodiscard]] bool needs_colors(const Microgeometry& microgeometry);

/// Maps of a patch seen from directly above, size x size texels over one period.
struct PatchMaps {
  Image normals;  ///< 4 channels: unit normal, weight 0 where no upward facet is visible
  glm::vec3 mean_color{1.0F};
};

/// Casts one ray per texel centre. `size` is at least 1.
[[nodiscard]] PatchMaps patch_maps(const Patch& patch, int size);

}  // namespace footprint
