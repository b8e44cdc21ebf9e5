// The mixtures of every texel of every level: coarse to fine, each level in scanline order.
#pragma once

#include <span>
#include <vector>

#include "methods/tan_gmm/samples.hpp"
#include "methods/tan_gmm/texel_fit.hpp"
#include "renderer/core/progress.hpp"

namespace footprint::tan_gmm {

/// The moments of a mixture that a linear filter can interpolate, stored in place of the variance: corrected holds
/// alpha (2 sigma^2 + |mu|^2), the second moment of an isotropic Gaussian of the disc; published holds Tan's
/// alpha (sigma^2 + |mu|^2), which is that of one dimension.
enum class Moment { corrected, published };

/// One mip chain for each component, finest level first: 4 channels, alpha, alpha mu_x, alpha mu_y and alpha times the
/// second moment, each times the part of the texel that valid normals cover (Tan 2005, section 4.2).
using MixtureChain = std::vector<std::vector<Image>>;

/// With a whole covariance six channels a component, alpha, alpha mu_x, alpha mu_y, alpha times the second moments xx,
/// xy, yy, packed one component after the other into images of four channels.
[[nodiscard]] constexpr std::size_t layers_of(const FitSettings& settings) {
  return settings.full_covariance ? (6 * settings.components + 3) / 4 : settings.components;
}

/// Fits all levels. The result does not depend on the number of threads. Reports progress from the calling thread.
[[nodiscard]] MixtureChain mixture_chain(const NormalField& normals, const FitSettings& settings, Moment moment,
                                         const Progress& progress);

}  // namespace footprint::tan_gmm
