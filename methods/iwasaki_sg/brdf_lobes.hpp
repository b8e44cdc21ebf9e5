// A small-scale BRDF's density of half vectors as a sum of spherical Gaussians about the half vector.
#pragma once

#include <functional>
#include <vector>

#include "renderer/scene/material.hpp"

namespace footprint::iwasaki_sg {

/// amplitude e^{sharpness (n.h - 1)}.
struct BrdfLobe {
  double sharpness;
  double amplitude;  ///< above 0
};

/// Fits non-negative SGs of fixed sharpness, spread evenly on a log scale, to a density `value(u)` of u = 1 - n.h in
/// [0, 1] by least squares over solid angle; those that get nothing are left out. `width` is the u over which the
/// density's core falls off.
[[nodiscard]] std::vector<BrdfLobe> fit_lobes(const std::function<double(double)>& value, double width);

/// The lobes of a base BRDF's normal distribution of unit energy. Blinn-Phong: one, of sharpness exponent + 1 (the
/// paper's exponent and (n + 2) / 2 pi carry 1 / n too much energy over solid angle); vmf: itself; Beckmann and GGX:
/// fitted.
[[nodiscard]] std::vector<BrdfLobe> lobes_of(NormalDistribution distribution, double parameter);

/// Ward's isotropic lobe e^{-tan^2 / alpha^2} / (4 pi alpha^2) (1992), without its root of cosines.
[[nodiscard]] std::vector<BrdfLobe> ward_lobes(double alpha);

/// The sum at u = 1 - n.h.
[[nodiscard]] double value(const std::vector<BrdfLobe>& lobes, double u);

}  // namespace footprint::iwasaki_sg
