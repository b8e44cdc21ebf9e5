// The bound of a comparison: the image of `exact`, which no method can beat under the same footprint filter. It covers
// the requested part of the frame, or as much as is cheap.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/studies/error_causes.hpp"
#include "experiments/studies/stage.hpp"

namespace footprint {

/// The image of `exact`, and where it was rendered.
struct BoundPicture {
  Image picture;  ///< RGBA
  Image pixels;   ///< a mask of the interior pixels in which it was drawn, and is finite
};

/// `exact` over a stage, where this build has it, `use` wants it and it knows every effect of the scene; none
/// otherwise, and the last reason is added to `warnings`.
[[nodiscard]] std::optional<StagedMethod> stage_bound(const Stage& stage, BoundUse use,
                                                      std::vector<std::string>& warnings);

/// Whole if requested or cheap, else in squares. `texels` are those of Interior.
[[nodiscard]] BoundPicture draw_bound(const Stage& stage, const StagedMethod& bound, BoundUse use, const View& view,
                                      const PixelParts& parts, const Image& texels);

}  // namespace footprint
