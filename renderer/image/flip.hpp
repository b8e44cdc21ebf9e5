// FLIP: how different two images look to an observer who alternates between them. Andersson, Nilsson,
// Akenine-Moeller, Oskarsson, Astrom, Fairchild 2020, "FLIP: A Difference Evaluator for Alternating Images", HPG; and
// for high dynamic range Andersson, Nilsson, Shirley, Akenine-Moeller 2021, "Visualizing Errors in Rendered High
// Dynamic Range Images".
#pragma once

#include "renderer/image/image.hpp"

namespace footprint {

/// Pixels per degree of sight: a display 0.7 m wide with 3840 pixels, seen from 0.7 m, as in the paper.
inline constexpr double flip_pixels_per_degree = 67.02064327658226;

/// LDR-FLIP per pixel, one channel, 0 (no visible difference) to 1. Images of 3 or 4 channels, the fourth ignored;
/// linear RGB as displayed, clamped to [0, 1]; the border's values continue beyond it.
/// pixels_per_degree: above 0.
/// Throws Error (usage): different sizes, other than 3 or 4 channels, or a value that is not finite.
[[nodiscard]] Image ldr_flip(const Image& picture, const Image& reference,
                             double pixels_per_degree = flip_pixels_per_degree);

/// The exposures of which HDR-FLIP takes the largest LDR-FLIP, in f-stops.
struct FlipExposures {
  double start = 0;  ///< the brightest pixel of the reference comes out at 0.85 of white
  double stop = 0;   ///< its median luminance does
  int count = 2;     ///< evenly spaced, ends included: a stop apart at most, 2 at least
};

/// The exposures for a reference of linear radiance, by the ACES tone curve (Narkowicz 2015). The median of an even
/// count is the upper middle value, as in NVIDIA's program (NVlabs/flip, src/cpp/FLIP.h, commit fa379684,
/// computeExposures). A black reference gives 0, 0. A median of 0 is replaced by the smallest luminance above it:
/// NVIDIA's stops would be infinite, and a fixed minimum would make HDR-FLIP depend on the unit of radiance.
[[nodiscard]] FlipExposures flip_exposures(const Image& reference);

/// HDR-FLIP per pixel, one channel, of linear radiance at any exposure. Negative radiance counts as 0. Throws as
/// ldr_flip.
[[nodiscard]] Image hdr_flip(const Image& picture, const Image& reference, const FlipExposures& exposures,
                             double pixels_per_degree = flip_pixels_per_degree);

}  // namespace footprint
