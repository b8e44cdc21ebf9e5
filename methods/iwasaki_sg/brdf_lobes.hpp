// A small-scale BRDF's density of half vectors as a sum of spherical Gaussians about the half vector.
#pragma once

#include <functional>
#include <vector>

#include "renderer/lobes/lobe.hpp"
#include "renderer/microgeometry/tabulated_brdf.hpp"

namespace footprint::iwasaki_sg {

/// amplitude e^{sharpness (n.h - 1)}.
struct BrdfLobe {
  double sharpness;
  double amplitude;  ///< 0 or above
};

/// Fits non-negative SGs of fixed sharpness, spread evenly on a log scale, to a density `value(u)` of u = 1 - n.h in
/// [0, 1] by least squares over solid angle; those that get nothing have amplitude 0. The sharpnesses are a function
/// of `width` alone. `width` is the u over which the
/// density's core falls off.
[[nodiscard]] std::vector<BrdfLobe> fit_lobes(const std::function<double(double)>& value, double width);

/// The spherical Gaussians of a base BRDF's lobe, of unit energy. Blinn-Phong: one, of sharpness exponent + 1 (the
/// paper's exponent and (n + 2) / 2 pi carry 1 / n too much energy over solid angle); vmf: itself; Beckmann and GGX:
/// fitted.
[[nodiscard]] std::vector<BrdfLobe> lobes_of(const Lobe& lobe);

/// A lobe in colour.
struct ColorLobe {
  double sharpness;
  glm::vec3 amplitude;  ///< 1/sr
};

/// A tabulated BRDF as diffuse + (lobes of the half vector) * rise: what pairs of directions at a difference angle have
/// over the mean of those up to 45 degrees, Fresnel's rise to grazing angles among it.
struct TabulatedLobes {
  glm::vec3 diffuse{0.0F};  ///< 1/sr
  std::vector<ColorLobe> lobes;
  std::vector<glm::vec3> rise;  ///< of each cell of theta_d
};

/// The lobes are fitted in each channel to the mean over difference angles up to 45 degrees as a function of theta_h,
/// of which the least is the diffuse term; the rise of each cell of theta_d to the whole by least squares.
[[nodiscard]] TabulatedLobes lobes_of(const TabulatedBrdf& brdf);

/// The rise at a difference angle (radians), linear between the cells' centres.
[[nodiscard]] glm::dvec3 rise_at(const TabulatedLobes& lobes, double theta_d);

/// The sum at u = 1 - n.h.
[[nodiscard]] double value(const std::vector<BrdfLobe>& lobes, double u);

}  // namespace footprint::iwasaki_sg
