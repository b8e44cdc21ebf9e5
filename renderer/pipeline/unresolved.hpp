// Pixels in which a reference has not converged, by its own standard error.
#pragma once

#include "renderer/pipeline/supersample.hpp"

namespace footprint {

/// When a pixel counts as unresolved: in any channel its standard error is above `relative` of its mean, and above
/// `displayed` once exposed, so that it can be seen at all.
struct UnresolvedLimits {
  double relative = 0.5;    ///< one block of four that has all of the light: 1; two of them: 0.58
  double displayed = 0.01;  ///< of what a display of peak 1 shows
  double most = 0.05;       ///< of the object's pixels: where more are, the reference is noisy, and none counts
};

/// One channel, 1 in the object's unresolved pixels: those that a few samples, which another seed would not have, bring
/// nearly all of their light, as the highlights of punctual lights on a mirror do. Else 0.
[[nodiscard]] Image unresolved(const Supersampled& reference, float exposure, const UnresolvedLimits& limits = {});

/// Takes the pixels of `mask` out of all figures over the reference: their coverage becomes 0 in its mean and halves.
void leave_out(Supersampled& reference, const Image& mask);

/// The same for one picture.
void uncover(Image& picture, const Image& mask);

/// Pixels at which a mask is above 0.
[[nodiscard]] std::size_t pixel_count(const Image& mask);

}  // namespace footprint
