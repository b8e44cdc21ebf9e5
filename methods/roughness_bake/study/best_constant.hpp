// The constant that `fit` has: of alpha'^2 = alpha^2 + c / kappa the c whose one lobe is closest to the true
// distribution of normals, by brute force.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "renderer/lobes/lobe.hpp"

namespace footprint::roughness_bake {

/// Facets of a lobe of `alpha` (alpha^2 twice its slope variance) over texels whose slopes are an even Gaussian of
/// deviation `sigma` per axis: the true NDF, and one lobe about the mean normal in its place.
class WidenedLobe {
 public:
  WidenedLobe(NormalDistribution distribution, double alpha, double sigma);

  /// The relative L2 difference, over solid angle, between the true NDF and the lobe of alpha^2 + c / kappa.
  [[nodiscard]] double error(double c) const;

  /// The same of the lobe of that alpha^2.
  [[nodiscard]] double error_of(double alpha2) const;

  /// What the texels' mean normal is short of length 1 by.
  [[nodiscard]] double shortfall() const { return shortfall_; }

 private:
  NormalDistribution distribution_;
  double alpha_, shortfall_;
  std::vector<double> angles_, truth_;  // from the mean normal, radians; density there
};

/// The c from 0 to 4 with the least mean of the errors over those deviations, to 0.005.
[[nodiscard]] double best_constant(NormalDistribution distribution, double alpha, std::span<const double> sigmas);

/// Deviations that bumps have from fine to coarse: what `fit` stands for.
inline constexpr std::array<double, 4> fit_sigmas{0.05, 0.1, 0.2, 0.35};

}  // namespace footprint::roughness_bake
