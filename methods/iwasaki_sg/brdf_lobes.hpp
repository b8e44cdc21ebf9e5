// A small-scale BRDF's density of half vectors as a sum of spherical Gaussians about the half vector.
#pragma once

#include <functional>
#include <vector>

#include "renderer/microgeometry/tabulated_brdf.hpp"
#include "renderer/scene/material.hpp"

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

/// The lobes of a base BRDF's normal distribution of unit energy. Blinn-Phong: one, of sharpness exponent + 1 (the
/// paper's exponent and (n + 2) / 2 pi carry 1 / n too much energy over solid angle); vmf: itself; Beckmann and GGX:
/// fitted.
[[nodiscard]] std::vector<BrdfLobe> lobes_of(NormalDistribution distribution, double parameter);

/// A lobe in colour.
struct ColorLobe {
  double sharpness;     ///< 0: the same in all directions, the diffuse term
  glm::vec3 amplitude;  ///< 1/sr
};

/// A tabulated BRDF as lobes of the half vector: its mean over difference angles up to 45 degrees as a function of
/// theta_h, of which the least is the diffuse term and the rest fitted in each channel.
[[nodiscard]] std::vector<ColorLobe> lobes_of(const TabulatedBrdf& brdf);

/// The sum at u = 1 - n.h.
[[nodiscard]] double value(const std::vector<BrdfLobe>& lobes, double u);

}  // namespace footprint::iwasaki_sg
