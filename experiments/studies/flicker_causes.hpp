// What flicker is made of (docs/metrics.md): the same parts of the picture and the same bound as of errors, over two
// frames.
#pragma once

#include "experiments/studies/bound.hpp"
#include "experiments/studies/error_causes.hpp"
#include "renderer/pipeline/supersample.hpp"
#include "results/report/animation_report.hpp"

namespace footprint {

/// What one frame's pictures are held against.
struct FrameReference {
  Supersampled reference;
  PixelParts parts;
  std::optional<BoundPicture> bound;
};

/// Of a method that drew `before` and then `picture`.
[[nodiscard]] FlickerCauses flicker_causes(const Image& before, const Image& picture,
                                           const FrameReference& target_before, const FrameReference& target,
                                           float exposure);

}  // namespace footprint
