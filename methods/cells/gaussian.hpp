// Anisotropic Gaussians over the plane, from weighted sums, and their log densities as polynomials.
#pragma once

#include <glm/glm.hpp>

namespace footprint::cells {

/// Weighted sums over points, which add up from texels to blocks to larger blocks.
struct PlaneSums {
  double weight = 0.0;
  glm::dvec2 first{0.0};
  glm::dvec3 second{0.0};  ///< xx, xy, yy

  void add(const glm::dvec2& p, double w);
  void add(const PlaneSums& others);
};

/// c + b.p - p^T A p / 2: a log density, or a sum of several.
struct Quadratic {
  double c = 0.0;
  glm::dvec2 b{0.0};
  glm::dvec3 a{0.0};  ///< xx, xy, yy

  void add(const Quadratic& other, double factor);
  [[nodiscard]] double at(const glm::dvec2& p) const;
};

/// log(share g). g is the Gaussian with the mean and the covariance of the sums, widened by `lobe_floor` of the base
/// lobe. `variance` is the slope variance of the base lobe, which over the plane is variance ((1 + |mean|^2) / 2)^2 per
/// axis.
[[nodiscard]] Quadratic log_density(const PlaneSums& sums, double share, double variance);

/// The share of the base lobe's variance that widens a part. It is well below one, so that parts are separated even if
/// the lobe blurs them into one peak.
inline constexpr double lobe_floor = 0.1;

}  // namespace footprint::cells
