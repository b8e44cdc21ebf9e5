// Takes a reference further, tile by tile, until its noise is small enough.
#pragma once

#include <cstdint>

#include "renderer/pipeline/supersample.hpp"

namespace footprint {

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
