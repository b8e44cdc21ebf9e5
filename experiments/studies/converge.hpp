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
  double most_work = 3;  ///< samples that are taken at most, over all that the picture has already; above 0
};

/// Tiles of 128 x 128 pixels whose noise floor, unresolved pixels left out, is above `noise` are taken anew with four
/// times the samples, again and again, the noisiest first. Each tile's pixels are those of a picture of so many
/// samples: which tiles go on depends on the first picture alone, and not on time. Returns the mean samples a pixel
/// that the picture has in the end.
double converge(const Supersampler& sampler, Supersampled& picture, const View& view, std::uint64_t seed,
                const Convergence& wanted, const Progress& progress);

}  // namespace footprint
