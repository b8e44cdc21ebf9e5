// The lobe of common_slopes.glsl once more, in doubles and by another road: an explicit tangent frame, numerical
// eigenvectors, no closed form of a root.
#pragma once

#include <glm/glm.hpp>

#include "renderer/scene/material.hpp"

namespace footprint::testing {

/// D of the base BRDF at h about n, lobe parameter as in docs/explanation/base-brdf.md.
[[nodiscard]] double base_density(NormalDistribution distribution, double lobe, const glm::dvec3& n,
                                  const glm::dvec3& h);

/// The mean of the base lobes about all valid texels of a material with one lobe.
[[nodiscard]] double mean_facet_density(const Material& material, const glm::dvec3& h);

/// Mean slope, covariance of the texels' slopes and the base lobe about each of them.
struct SlopeTwin {
  glm::dvec2 mean;
  glm::dmat2 spread;
  NormalDistribution distribution;
  double lobe;

  [[nodiscard]] glm::dvec3 axis() const;
  [[nodiscard]] double variance() const;  ///< slope variance of the base lobe, per axis

  /// Density over solid angle: the base lobe stretched to the covariance, and the Gaussian of slopes.
  [[nodiscard]] double stretched(const glm::dvec3& h) const;
  [[nodiscard]] double gaussian(const glm::dvec3& h) const;
};

/// The twin over all texels of a material that has a normal map and a lobe parameter.
[[nodiscard]] SlopeTwin slope_twin_of(const Material& material);

}  // namespace footprint::testing
