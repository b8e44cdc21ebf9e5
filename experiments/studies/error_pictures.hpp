// The error images of a comparison, made from the images that were written: on the scale of each distance, on the scale
// that all distances share, and in strips side by side.
#pragma once

#include <filesystem>
#include <optional>
#include <span>

#include "experiments/studies/distance_result.hpp"
#include "renderer/image/image.hpp"

namespace footprint {

/// The 99th percentile of an error image over the pixels that have an error.
[[nodiscard]] double error_percentile(const Image& error);

/// The top of the false-colour scale for errors up to `largest`: two digits, 0.01 or more.
/// given: the scale that was requested, which is then returned.
[[nodiscard]] double error_scale(double largest, const std::optional<double>& given);

/// Writes the strips of a distance and its error images on the scale `top`, and names them in the records; the images
/// on the shared scale are the same until write_shared_error_images. folder: output folder with the images of `result`.
void write_error_images(const std::filesystem::path& folder, DistanceResult& result, double top);

/// Writes the error images of a distance on the scale `top` that all distances share, and names them in the records.
void write_shared_error_images(const std::filesystem::path& folder, DistanceResult& result, double top);

}  // namespace footprint
