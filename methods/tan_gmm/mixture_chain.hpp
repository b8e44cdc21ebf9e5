// Fits the mixtures of every texel of every level, from coarse to fine, each level in scanline order.
#pragma once

#include <span>
#include <vector>

#include "methods/tan_gmm/em.hpp"
#include "methods/tan_gmm/samples.hpp"
#include "renderer/core/progress.hpp"

namespace footprint::tan_gmm {

/// Clusters of the samples as components (Tan 2005, section 4.1): the most distant centres, then Lloyd's steps. If
/// there are fewer distinct samples than components, the others get alpha 0.
void cluster_start(const Samples& samples, std::span<Gaussian> mixture);

/// All components but one from clusters, and one of variance 1e-4 on the heaviest cell of a histogram, because clusters
/// miss spikes of equal normals inside a wider spread. Needs two components.
void dense_start(const Samples& samples, std::span<Gaussian> mixture);

/// Orders the components, arbitrary in clusters, so that the prior is greatest. Those of alpha 0 get the prior's mean.
void match_order(const Prior& prior, std::span<Gaussian> mixture);

/// Fits `mixture` to the samples. `parent`: the coarser texel's mixture, or empty. Without samples every alpha is 0.
void fit_texel(const Samples& samples, const Prior& prior, std::span<const Gaussian> parent,
               const FitSettings& settings, std::span<Gaussian> mixture);

/// The stored second moment, which a linear filter can interpolate. corrected: alpha (2 sigma^2 + |mu|^2), that of an
/// isotropic Gaussian of the disc. published: Tan's alpha (sigma^2 + |mu|^2), that of one dimension.
enum class Moment { corrected, published };

/// One mip chain per component, finest level first. Its 4 channels are alpha, alpha mu_x, alpha mu_y and alpha times
/// the second moment, all times the share of the texel that valid normals cover (Tan 2005, section 4.2).
using MixtureChain = std::vector<std::vector<Image>>;

/// With a full covariance six channels per component: alpha, alpha mu_x, alpha mu_y, and alpha times the second moments
/// xx, xy, yy. Components follow each other in images of four channels.
[[nodiscard]] constexpr std::size_t layers_of(const FitSettings& settings) {
  return settings.full_covariance ? (6 * settings.components + 3) / 4 : settings.components;
}

/// Fits all levels. Equal results at any number of threads. Calls progress from the calling thread.
[[nodiscard]] MixtureChain mixture_chain(const NormalField& normals, const FitSettings& settings, Moment moment,
                                         const Progress& progress);

}  // namespace footprint::tan_gmm
