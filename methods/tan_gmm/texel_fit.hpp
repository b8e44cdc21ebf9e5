// The mixture of one texel: the best of several starts of EM.
#pragma once

#include <span>

#include "methods/tan_gmm/em.hpp"

namespace footprint::tan_gmm {

/// Clusters of the samples as components (Tan 2005, section 4.1): the most distant centres, then Lloyd's steps. If
/// there are fewer distinct samples than components, the others get alpha 0.
void cluster_start(const Samples& samples, std::span<Gaussian> mixture);

/// All components but one from clusters, and one of variance 1e-4 on the heaviest cell of a histogram, because clusters
/// miss spikes of equal normals inside a wider spread. Needs two components.
void dense_start(const Samples& samples, std::span<Gaussian> mixture);

/// Orders the components so that the prior is greatest, because the order of clusters is arbitrary. Components of alpha
/// 0 get the prior's mean.
void match_order(const Prior& prior, std::span<Gaussian> mixture);

/// Fits `mixture` to the samples. `parent`: the coarser texel's mixture, or empty. Without samples every alpha is 0.
void fit_texel(const Samples& samples, const Prior& prior, std::span<const Gaussian> parent,
               const FitSettings& settings, std::span<Gaussian> mixture);

}  // namespace footprint::tan_gmm
