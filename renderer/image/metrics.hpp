// The error measures of metrics.md, over the object's pixels.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "renderer/image/image.hpp"

namespace footprint {

/// The number of pixels by luminance (Rec. 709, of exposed values clamped to [0, 1]): bin i covers i / 32 to (i + 1) /
/// 32, the last one including white.
using LuminanceHistogram = std::array<std::uint32_t, 32>;

/// The differences of an image from the reference, over object pixels: those whose reference coverage is 1.
struct ErrorFigures {
  double normalized_color = 0;    ///< Tan 2005: mean of |rgb - rgb_ref| / sqrt(3) on exposed values clamped to [0,1]
  double relative_rmse = 0;       ///< sqrt(sum |x - r|^2 / sum |r|^2) on linear radiance
  double relmse = 0;              ///< mean of (x - r)^2 / (r^2 + epsilon), epsilon in metrics.md
  double psnr = 0;                ///< dB, peak 1, on exposed clamped values; infinite for equal images
  double energy_bias = 0;         ///< (sum x - sum r) / sum r on linear radiance, signed
  double luminance_distance = 0;  ///< mean of |y - y_ref| of exposed clamped luminances, each image's sorted on its own
  std::optional<double> smape = {};  ///< mean of |x - r| / (|x| + |r|) on linear radiance; none: no interior pixel
  std::optional<double> ssim = {};   ///< Wang 2004: mean structural similarity of displayed luminances (ssim.hpp)
  LuminanceHistogram luminances{}, reference_luminances{};  ///< of the object's pixels
};

/// Compares RGBA images of one size: linear radiance (mean over the covered part of the pixel), and coverage in alpha.
/// Pixels that the image leaves uncovered count as black. Empty without object pixels. Throws Error (usage): different
/// sizes, other than 4 channels, or an object pixel that is not finite.
/// interior: the pixels of `smape`, one channel, above 0; an empty image has all.
[[nodiscard]] std::optional<ErrorFigures> compare_images(const Image& picture, const Image& reference, float exposure,
                                                         const Image& interior = {});

/// The normalised colour error only, over the object pixels in `mask` (one channel, above 0); an empty mask has all.
/// Empty without any. Throws as compare_images.
[[nodiscard]] std::optional<double> normalized_color(const Image& picture, const Image& reference, float exposure,
                                                     const Image& mask = {});

/// Flicker: how the change of an image from the previous frame differs from the reference's (metrics.md).
struct FlickerFigures {
  double mean = 0;  ///< of |(d(x) - d(x')) - (d(r) - d(r'))| / sqrt(3), ' the frame before; exposed, clamped values
  double p99 = 0;   ///< its 99th percentile (nearest rank)
};

/// Compares the change from `before` to `picture` with that of the reference. RGBA images of one size; over the pixels
/// in `mask`, as normalized_color takes it, that both references cover wholly. Values of others need not be finite.
/// Empty without any. Throws as compare_images.
[[nodiscard]] std::optional<FlickerFigures> compare_changes(const Image& before, const Image& picture,
                                                            const Image& reference_before, const Image& reference,
                                                            float exposure, const Image& mask = {});

/// The trailing edges of highlights: 1 where both references cover the pixel wholly and displayed luminance fell by
/// `trailing_fall` or more from `reference_before` to `reference`, of one size; elsewhere 0.
[[nodiscard]] Image trailing_edges(const Image& reference_before, const Image& reference, float exposure);

/// The energy of highlights: the mean over object pixels of exposed luminance above `highlight_level`, not clamped.
/// Empty without object pixels. Throws as compare_images.
[[nodiscard]] std::optional<double> highlight_energy(const Image& picture, const Image& reference, float exposure);

/// The exposed luminance at which highlights start: automatic exposure maps the brightest twentieth of the reference to
/// it.
inline constexpr double highlight_level = 0.8, trailing_fall = 0.1;

/// The normalised colour error per pixel, one channel, 0 outside the object; shown in false colour.
[[nodiscard]] Image error_map(const Image& picture, const Image& reference, float exposure);

/// The number of pixels whose reference coverage is 1.
[[nodiscard]] std::size_t object_pixel_count(const Image& reference);

/// A mask of these pixels: one channel, 1 or 0.
[[nodiscard]] Image object_pixels(const Image& reference);

}  // namespace footprint
