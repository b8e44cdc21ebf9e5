// The constant of `fit`, by brute force: the c of alpha'^2 = alpha^2 + c / kappa whose lobe is closest to the true NDF.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "renderer/lobes/lobe.hpp"

namespace footprint::roughness_bake {

/// The true NDF of facets with a lobe of `alpha` (alpha^2 is twice its slope variance) over texels with Gaussian slopes
/// of deviation `sigma` per axis, and the single lobe about the mean normal that replaces it.
class WidenedLobe {
 public:
  WidenedLobe(NormalDistribution distribution, double alpha, double sigma);

  /// The relative L2 difference, over solid angle, between the true NDF and the lobe of alpha^2 + c / kappa.
  [[nodiscard]] double error(double c) const;

  /// The relative L2 difference for the lobe of alpha^2 = `alpha2`.
  [[nodiscard]] double error_of(double alpha2) const;

  /// 1 minus the length of the texels' mean normal.
  [[nodiscard]] double shortfall() const { return shortfall_; }

 private:
  NormalDistribution distribution_;
  double alpha_, shortfall_;
  std::vector<double> angles_, exact_;  // from the mean normal, radians; density there
};

/// The c from 0 to 4 with the least mean error over the deviations, within 0.005.
[[nodiscard]] double best_constant(NormalDistribution distribution, double alpha, std::span<const double> sigmas);

/// Deviations of bumps from fine to coarse, for which `fit` is optimised.
inline constexpr std::array<double, 4> fit_sigmas{0.05, 0.1, 0.2, 0.35};

}  // namespace footprint::roughness_bake
