// Anisotropic Gaussians over the plane: sums that give one, and its log density as a polynomial.
#pragma once

#include <glm/glm.hpp>

namespace footprint::cells {

/// Weighted sums over points: what is added up from texel to block to larger block.
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

/// log(share g), g the Gaussian with the sums' mean, and with their covariance widened by `floor` of the base lobe's,
/// of slope variance `variance`: over the plane that is variance ((1 + |mean|^2) / 2)^2 per axis.
[[nodiscard]] Quadratic log_density(const PlaneSums& sums, double share, double variance);

/// What of the base lobe's variance joins that of a part: well below one, so that parts are told apart that the lobe
/// blurs to a shoulder.
inline constexpr double lobe_floor = 0.1;

}  // namespace footprint::cells
