// Pixel values for the report page. A page that is opened from disk may show images beside it, but not read their
// pixels; it may load a script beside it.
#pragma once

#include <filesystem>

#include "renderer/image/image.hpp"

namespace footprint {

/// Writes the values of an image of 1, 3 or 4 channels as a script, which sets `pixels` of the element that loads it to
/// a PNG (a data URL) of three parts, one below the other. The first has the high bytes of RGB as 16-bit floats, the
/// second the low bytes. The third has the coverage: 0 none, 255 whole, 254 whole but left out of every figure.
/// Radiance is clamped to the range of 16-bit floats, and is 0 where nothing is covered. left_out: a mask of one
/// channel; empty: every pixel counts. Errors (machine): as write_exr.
void write_pixel_script(const std::filesystem::path& file, const Image& image, const Image& left_out = {});

}  // namespace footprint
