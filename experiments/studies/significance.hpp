// Where one picture is closer to the reference than another by more than the reference's noise explains.
#pragma once

#include <optional>

#include "renderer/pipeline/supersample.hpp"

namespace footprint {

/// What a pixel says of two pictures: one channel, the size of the reference; 1 where `a` is closer, -1 where `b` is,
/// 0 where noise does not let it be told, and where the object does not cover the pixel whole. Closer is by the
/// normalised colour error (docs/metrics.md), beyond three standard errors of the reference. RGBA pictures of the
/// reference's size. None where the reference does not know its noise (fewer than two passes).
[[nodiscard]] std::optional<Image> closer_beyond_noise(const Image& a, const Image& b, const Supersampled& reference,
                                                       float exposure);

/// The same with the reference's mean and standard error (RGB) in pictures of their own.
[[nodiscard]] Image closer_beyond_noise(const Image& a, const Image& b, const Image& mean, const Image& standard_error,
                                        float exposure);

/// Verdicts in display values: blue where `a` is closer, vermilion where `b` is, grey where neither, white outside of
/// `object` (one channel, above 0).
[[nodiscard]] Image verdict_picture(const Image& verdicts, const Image& object);

/// Shares of the mask's pixels (one channel, above 0) by what they say.
struct CloserShares {
  double a = 0, b = 0;
};

/// None where the mask is empty.
[[nodiscard]] std::optional<CloserShares> closer_shares(const Image& verdicts, const Image& mask);

}  // namespace footprint
