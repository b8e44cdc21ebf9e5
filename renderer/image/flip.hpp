// FLIP: how different two images look to an observer who alternates between them. Andersson, Nilsson,
// Akenine-Moeller, Oskarsson, Astrom, Fairchild 2020, "FLIP: A Difference Evaluator for Alternating Images", HPG; and
// for high dynamic range Andersson, Nilsson, Shirley, Akenine-Moeller 2021, "Visualizing Errors in Rendered High
// Dynamic Range Images".
#pragma once

#include "renderer/image/image.hpp"

namespace footprint {

/// Pixels per degree of sight: a display 0.7 m wide with 3840 pixels, seen from 0.7 m, as in the paper.
inline constexpr double flip_pixels_per_degree = 67.02064327658226;

/// LDR-FLIP of every pixel, one channel, 0 (no difference is seen) to 1. Three or four channels, the fourth is not
/// looked at; linear RGB as displayed, clamped to 0 to 1. Beyond the border images go on as at it. `pixels_per_degree`
/// above 0. Throws Error (usage): images of different sizes, other than 3 or 4 channels, a value that is not finite.
[[nodiscard]] Image ldr_flip(const Image& picture, const Image& reference,
                             double pixels_per_degree = flip_pixels_per_degree);

/// The exposures over which HDR-FLIP takes the largest LDR-FLIP, in f-stops.
struct FlipExposures {
  double start = 0;  ///< the brightest pixel of the reference comes out at 0.85 of white
  double stop = 0;   ///< its median luminance does
  int count = 2;     ///< evenly spaced, ends included: a stop apart at most, 2 at least
};

/// Those of a reference, linear radiance, by the ACES tone curve (Narkowicz 2015). The median of an even count is the
/// upper of the two in the middle, as in NVIDIA's own program (NVlabs/flip, src/cpp/FLIP.h, commit fa379684,
/// computeExposures). A black reference: 0, 0. A median of 0 counts as the smallest luminance above it: there NVIDIA's
/// stops are infinite, and a fixed least luminance would let HDR-FLIP depend on the unit of radiance.
[[nodiscard]] FlipExposures flip_exposures(const Image& reference);

/// HDR-FLIP of every pixel, one channel: of linear radiance, whatever its exposure. Negative radiance counts as none.
/// Throws as ldr_flip's.
[[nodiscard]] Image hdr_flip(const Image& picture, const Image& reference, const FlipExposures& exposures,
                             double pixels_per_degree = flip_pixels_per_degree);

}  // namespace footprint
