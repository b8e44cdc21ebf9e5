// Normals as points of a plane, with weights; anisotropic Gaussians over it, from weighted sums, and their log
// densities as polynomials.
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <vector>

#include "renderer/image/image.hpp"

namespace footprint::cells {

/// The plane of the moments.
enum class Coordinates { stereographic, slopes };

/// n_xy / (1 + n_z) of a unit normal: the stereographic projection from the pole below. It is conformal, and the
/// horizon has length 1. Normals below the horizon are moved onto it.
[[nodiscard]] inline glm::dvec2 stereographic_of(const glm::dvec3& normal) {
  const glm::dvec2 p = glm::dvec2(normal) / (1.0 + std::max(normal.z, 0.0));
  return normal.z < 0.0 ? p / std::max(glm::length(p), 1e-12) : p;
}

/// A normal of the map as a point; invalid normals have weight 0.
struct PlanePoint {
  glm::dvec2 at{0.0};
  double weight = 0.0;
};

/// The points of a normal map (RGBA: normal, weight), row by row. Slopes are limited to `steepest`.
[[nodiscard]] std::vector<PlanePoint> plane_points(const Image& normals, Coordinates coordinates, double steepest);

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
