// The exposure of a scene that names none.
#pragma once

#include <optional>
#include <string>

#include "renderer/image/image.hpp"
#include "renderer/scene/scene.hpp"

namespace footprint {

/// The factor that takes the 95th percentile of the luminance of a picture's object pixels to 0.8: bright parts keep
/// their drawing, the sharpest highlights clip. 1 where the picture is black or has no object pixel. RGBA with
/// coverage.
[[nodiscard]] float automatic_exposure(const Image& reference);

/// The exposure of a run and where it comes from.
struct ChosenExposure {
  float factor = 1;
  std::string source;  ///< "scene", "automatic" or "command line"
};

/// What is given, else the scene's own, else the automatic one of its first reference.
[[nodiscard]] ChosenExposure choose_exposure(const std::optional<float>& given, const Scene& scene,
                                             const Image& first_reference);

}  // namespace footprint
