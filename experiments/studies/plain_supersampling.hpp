// Plain supersampling as a program without any method would do it: the mean of whole frames whose samples lie elsewhere
// in the pixel. What methods are compared with at equal work: one sample a pixel is one frame, at pixel centres.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "renderer/core/progress.hpp"
#include "renderer/pipeline/frame.hpp"

namespace footprint {

/// Where in the pixel the samples lie, from its centre, in pixels, -0.5 to 0.5: of one sample the centre, of more the
/// points of Hammersley, no two of which share a row or column, moved by the seed around the pixel. `spp` is 1 or more.
[[nodiscard]] std::vector<glm::dvec2> frame_offsets(int spp, std::uint64_t seed);

/// The mean of a frame at each offset: RGBA, mean radiance over the frames that cover the pixel, and their share.
[[nodiscard]] Image mean_of_frames(const FrameRenderer& frames, const View& view, std::span<const glm::dvec2> offsets,
                                   const Progress& progress);

}  // namespace footprint
