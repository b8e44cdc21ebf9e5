// The effect of the reference's own noise on the figures that are measured against it (docs/reference/metrics.md), and
// further samples until it is small enough.
#pragma once

#include <cstdint>
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

/// When a reference is good enough.
struct Convergence {
  double noise = 0;  ///< of each tile: normalised colour error, as `noise_floor`
  float exposure = 1;
  int spp_max = 4096;
  double max_extra_work = 3;  ///< most further samples, over those that the image has already; above 0
};

/// Tiles of 128 x 128 pixels whose noise floor, unresolved pixels left out, is above `noise` are rendered again with
/// four times the samples, repeatedly, the noisiest first. Each tile equals that part of an image of as many samples.
/// The choice of tiles depends on the first image only, not on time. Returns the mean samples per pixel in the end.
double converge(const Supersampler& sampler, Supersampled& picture, const View& view, std::uint64_t seed,
                const Convergence& wanted, const Progress& progress);

}  // namespace footprint
