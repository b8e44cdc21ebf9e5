// The exposure of a run's pictures.
#pragma once

#include <optional>

#include "experiments/settings/run_settings.hpp"
#include "renderer/image/image.hpp"
#include "renderer/scene/scene.hpp"

namespace footprint {

/// The factor that takes the 95th percentile of the luminance of a picture's object pixels to 0.8: bright parts keep
/// their drawing, the sharpest highlights clip. 1 where the picture is black or has no object pixel. RGBA with
/// coverage.
[[nodiscard]] float automatic_exposure(const Image& reference);

/// The given exposure, else the scene's own, else the automatic one of its first reference.
[[nodiscard]] Exposure choose_exposure(const std::optional<Exposure>& given, const Scene& scene,
                                       const Image& first_reference);

}  // namespace footprint
