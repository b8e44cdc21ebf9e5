// The error measures of docs/metrics.md, over the object's pixels.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "renderer/image/image.hpp"

namespace footprint {

/// How many pixels are how bright: bin i counts those whose luminance (Rec. 709, of exposed values clamped to [0, 1])
/// lies from i / 32 to (i + 1) / 32; the last bin has white too.
using LuminanceHistogram = std::array<std::uint32_t, 32>;

/// What an image differs from the reference by. Only object pixels count: those whose reference coverage is 1.
struct ErrorFigures {
  double normalized_color = 0;    ///< Tan 2005: mean of |rgb - rgb_ref| / sqrt(3) on exposed values clamped to [0,1]
  double relative_rmse = 0;       ///< sqrt(sum |x - r|^2 / sum |r|^2) on linear radiance
  double relmse = 0;              ///< mean of (x - r)^2 / (r^2 + epsilon), epsilon in docs/metrics.md
  double psnr = 0;                ///< dB, peak 1, on exposed clamped values; infinite for equal images
  double energy_bias = 0;         ///< (sum x - sum r) / sum r on linear radiance, signed
  double luminance_distance = 0;  ///< mean of |y - y_ref| of exposed clamped luminances, each image's sorted on its own
  LuminanceHistogram luminances{}, reference_luminances{};  ///< of the object's pixels
};

/// Compares RGBA images of the same size: linear radiance (mean over the covered part of the pixel), coverage in
/// alpha. A pixel that the image left uncovered counts as black. Empty if the reference has no fully covered pixel.
/// Throws Error{usage} on different sizes, on other than 4 channels and on a NaN or infinity in an object pixel of
/// either (naming the pixel).
[[nodiscard]] std::optional<ErrorFigures> compare_images(const Image& picture, const Image& reference, float exposure);

/// The normalised colour error alone. Empty if there is no object pixel. Throws as compare_images.
[[nodiscard]] std::optional<double> normalized_color(const Image& picture, const Image& reference, float exposure);

/// The same over those object pixels at which `mask` (one channel, the size of the images)
/// is above 0. Empty if there is none. Throws as compare_images.
[[nodiscard]] std::optional<double> normalized_color_over(const Image& picture, const Image& reference, float exposure,
                                                          const Image& mask);

/// How otherwise an image changes from the frame before it than the reference does: flicker, docs/metrics.md.
struct FlickerFigures {
  double mean = 0;  ///< of |(d(x) - d(x')) - (d(r) - d(r'))| / sqrt(3), ' the frame before; exposed, clamped values
  double p99 = 0;   ///< its 99th percentile (nearest rank)
};

/// Compares the change from `before` to `picture` with that of the reference. RGBA images of one size, as for
/// compare_images; the pixels are those which both references cover wholly: empty if there is none. Throws as there.
[[nodiscard]] std::optional<FlickerFigures> compare_changes(const Image& before, const Image& picture,
                                                            const Image& reference_before, const Image& reference,
                                                            float exposure);

/// The same over those of these pixels at which `mask` (one channel, the size of the images) is above 0.
[[nodiscard]] std::optional<FlickerFigures> compare_changes_over(const Image& before, const Image& picture,
                                                                 const Image& reference_before, const Image& reference,
                                                                 float exposure, const Image& mask);

/// What bright pixels carry: the mean over object pixels of how far exposed luminance lies above `highlight_level`, not
/// clamped. Empty if there is no object pixel. Throws as compare_images.
[[nodiscard]] std::optional<double> highlight_energy(const Image& picture, const Image& reference, float exposure);

/// Exposed luminance from which on a pixel counts as a highlight: where an automatic exposure puts the brightest
/// twentieth of the reference.
inline constexpr double highlight_level = 0.8;

/// Per-pixel normalised colour error, one channel, 0 outside the object: what the false-colour image shows.
[[nodiscard]] Image error_map(const Image& picture, const Image& reference, float exposure);

/// Pixels whose reference coverage is 1.
[[nodiscard]] std::size_t object_pixel_count(const Image& reference);

/// Those pixels as a mask: one channel, 1 or 0.
[[nodiscard]] Image object_pixels(const Image& reference);

}  // namespace footprint
