// The mixture of one texel: the best of several starts of EM.
#pragma once

#include <span>

#include "methods/tan_gmm/em.hpp"

namespace footprint::tan_gmm {

/// Where EM starts. inherit: from the coarser texel's mixture where it is known, so that components keep their meaning
/// from level to level, else as dense_seed. dense_seed: the best of clusters, a seed on the densest spot and, where it
/// is known, the coarser texel's mixture. clusters: clusters alone, as the paper has it.
enum class Start { inherit, dense_seed, clusters };

struct FitSettings {
  std::size_t components = 4;  ///< 1 to most_components
  bool align = true;           ///< neighbours draw the means; else each texel on its own
  MStep m_step = MStep::exact;
  Start start = Start::inherit;
  bool full_covariance = false;  ///< a whole covariance each, by EM from the isotropic mixture on
  double prior_weight = 1.0;     ///< c of the prior
  int most_iterations = 40;      ///< EM steps from the best start
  int trial_iterations = 4;      ///< EM steps that each start is judged by
  double tolerance = 1e-4;       ///< gain of the log posterior, a unit of sample weight, that ends EM
};

/// Fits `mixture` to the samples. `parent`: the coarser texel's mixture, or empty. Without samples: every alpha is 0.
void fit_texel(const Samples& samples, const Prior& prior, std::span<const Gaussian> parent,
               const FitSettings& settings, std::span<Gaussian> mixture);

}  // namespace footprint::tan_gmm
