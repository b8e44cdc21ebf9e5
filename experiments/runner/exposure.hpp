// The exposure of a scene that names none.
#pragma once

#include "renderer/image/image.hpp"

namespace footprint {

/// The factor that takes the 95th percentile of the luminance of a picture's object pixels to 0.8: bright parts keep
/// their drawing, the sharpest highlights clip. 1 where the picture is black or has no object pixel. RGBA with
/// coverage.
[[nodiscard]] float automatic_exposure(const Image& reference);

}  // namespace footprint
