// Spherical Gaussians in forms that neither overflow nor cancel, and BRDFs as sums of them about the half vector.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "renderer/lobes/lobe.hpp"
#include "renderer/microgeometry/microgeometry.hpp"

namespace footprint::iwasaki_sg {

/// exp(sharpness (w.axis - 1)): an SG of unit amplitude (Iwasaki 2012, Eq. 3).
struct SphericalGaussian {
  glm::dvec3 axis{0.0, 0.0, 1.0};  ///< unit
  double sharpness = 1.0;          ///< eta, above 0

  friend bool operator==(const SphericalGaussian&, const SphericalGaussian&) = default;
};

/// 1 - a.b of unit vectors, from their difference, which is exact where the dot product loses digits.
[[nodiscard]] inline double one_minus_dot(const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 d = a - b;
  return 0.5 * glm::dot(d, d);
}

/// The value of the SG at a unit vector.
[[nodiscard]] double value(const SphericalGaussian& lobe, const glm::dvec3& direction);

/// The integral of the product of two SGs over the sphere (Eq. 11), exact up to rounding for any sharpness up to 1e6
/// and above.
[[nodiscard]] double convolution(const SphericalGaussian& a, const SphericalGaussian& b);

/// Approximates `convolution` by one SG in the angle between the axes (Eq. 14), accurate if both are sharp. The largest
/// error is 1.45 / (eta1 + eta2)^2 in the limit, and 1.6 / (eta1 + eta2)^2 if they sum to 10 or more.
[[nodiscard]] double approximate_convolution(const SphericalGaussian& a, const SphericalGaussian& b);

/// A lobe amplitude e^{sharpness (n.h - 1)}.
struct BrdfLobe {
  double sharpness;
  double amplitude;  ///< 0 or above
};

/// Fits non-negative SGs to a density `value(u)` of u = 1 - n.h in [0, 1] by least squares over solid angle. Their
/// sharpnesses are evenly spaced on a log scale and depend only on `width`, the u over which the core of the density
/// falls off. Unused SGs have amplitude 0.
[[nodiscard]] std::vector<BrdfLobe> fit_lobes(const std::function<double(double)>& value, double width);

/// The spherical Gaussians of a base BRDF's lobe, with unit energy. Blinn-Phong: one of sharpness exponent + 1, because
/// the paper's exponent and (n + 2) / 2 pi have an excess of 1 / n of the energy over solid angle. vmf: the lobe
/// itself. Beckmann and GGX: a fit.
[[nodiscard]] std::vector<BrdfLobe> lobes_of(const Lobe& lobe);

/// A lobe in colour.
struct ColorLobe {
  double sharpness;
  glm::vec3 amplitude;  ///< 1/sr
};

/// A tabulated BRDF as diffuse + (lobes of the half vector) * rise. The rise is the ratio of pairs of directions at a
/// difference angle to the mean up to 45 degrees, which includes Fresnel's rise to grazing angles.
struct TabulatedLobes {
  glm::vec3 diffuse{0.0F};  ///< 1/sr
  std::vector<ColorLobe> lobes;
  std::vector<glm::vec3> rise;  ///< of each cell of theta_d
};

/// Fits the lobes of each channel to the mean over difference angles up to 45 degrees as a function of theta_h, whose
/// minimum is the diffuse term. Fits the rise of each cell of theta_d by least squares.
[[nodiscard]] TabulatedLobes lobes_of(const TabulatedBrdf& brdf);

/// The rise at a difference angle (radians), linear between the centres of cells.
[[nodiscard]] glm::dvec3 rise_at(const TabulatedLobes& lobes, double theta_d);

/// The sum of the lobes at u = 1 - n.h.
[[nodiscard]] double value(const std::vector<BrdfLobe>& lobes, double u);

}  // namespace footprint::iwasaki_sg
