// What methods that rebuild their maps each frame cost, by the size of the map.
#pragma once

#include <string>

namespace footprint::bench {

/// A table over the surface `bumps` with maps of 512, 1024 and 2048 texels a side, drawn at 512 x 512: of each of
/// `methods` (commas between) the frame build, also a texel, shading over a frame of `direct`, and both over the
/// reference at 16 samples a pixel. CPU time, medians of `repeats` rounds. Errors (usage): unknown method or option.
[[nodiscard]] std::string frame_build_table(const std::string& methods, int repeats);

}  // namespace footprint::bench
