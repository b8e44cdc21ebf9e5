// The noise of a reference, and the samples that bring it down.
#pragma once

#include <cstdint>
#include <optional>

#include "renderer/core/progress.hpp"
#include "renderer/image/image.hpp"
#include "renderer/pipeline/supersample.hpp"
#include "renderer/pipeline/view.hpp"

namespace footprint {

/// The difference of a reference's two halves has so many times the deviation of the reference's own error.
inline constexpr double halves_over_whole = 2.0;

/// The normalised colour error that the reference's noise alone causes; none with fewer than two passes, or where the
/// object covers no whole pixel.
/// mask: as normalized_color takes it.
[[nodiscard]] std::optional<double> noise_floor(const Supersampled& reference, float exposure, const Image& mask = {});

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
