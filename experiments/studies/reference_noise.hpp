// The effect of the reference's own noise on the figures that are measured against it (docs/metrics.md).
#pragma once

#include <optional>

#include "renderer/pipeline/supersample.hpp"
#include "results/report/records.hpp"

namespace footprint {

/// The normalised colour error that the reference's noise alone causes; none with fewer than two passes, or where the
/// object covers no whole pixel.
[[nodiscard]] std::optional<double> noise_floor(const Supersampled& reference, float exposure);

/// The same over those object pixels at which `mask` (one channel) is above 0.
[[nodiscard]] std::optional<double> noise_floor_over(const Supersampled& reference, float exposure, const Image& mask);

/// A picture that was drawn with few samples, as it would be with as many as `converged` has: what it differs by from
/// `same`, which the reference drew with the picture's own samples, is added to `converged` (a control variate: the
/// noise that both have drops out). RGBA of one size; covered as `converged` is; no channel below 0.
[[nodiscard]] Image as_converged(const Image& picture, const Image& same, const Image& converged);

/// The flicker from the frame `before` to `picture`, with that which the references' noise alone causes. None where no
/// pixel is covered wholly in both.
[[nodiscard]] std::optional<Flicker> flicker_between(const Image& before, const Image& picture,
                                                     const Supersampled& reference_before,
                                                     const Supersampled& reference, float exposure);

}  // namespace footprint
