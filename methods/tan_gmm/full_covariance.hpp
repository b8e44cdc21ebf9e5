// Gaussians with a whole covariance: EM from an isotropic mixture on, under the same prior.
#pragma once

#include <span>

#include "methods/tan_gmm/em.hpp"
#include "methods/tan_gmm/texel_fit.hpp"

namespace footprint::tan_gmm {

/// alpha times a Gaussian over the disc.
struct FullGaussian {
  double alpha = 0.0;
  double x = 0.0, y = 0.0;              ///< mean
  double xx = 0.0, xy = 0.0, yy = 0.0;  ///< covariance, without the floor that EM keeps it above
};

/// Fits `mixture` to the samples, from `start`, component by component; means are drawn to the prior's as those of
/// isotropic Gaussians are, by what is the exact M-step here: (N I + 2 w S) mu = N m + 2 w S mu_0, S the covariance
/// before the step, w the prior's weight. Steps and tolerance are those of `settings`. A component without samples
/// keeps what it has, with alpha 0; without any samples all do.
void fit_full(const Samples& samples, const Prior& prior, const FitSettings& settings, std::span<const Gaussian> start,
              std::span<FullGaussian> mixture);

/// The round Gaussian of the same mean spread: what neighbours and finer levels see of it.
[[nodiscard]] Gaussian rounded(const FullGaussian& full);

}  // namespace footprint::tan_gmm
