// What frames cost over a zoom.
#pragma once

#include <string>
#include <vector>

#include "bench/bench_scene.hpp"

namespace footprint::bench {

/// Draws methods of a list, commas between, and `direct` at 512 x 512 at every distance: CPU milliseconds of a frame,
/// the median over `rounds`, and what they are in frames of `direct` drawn in the same rounds. A text, a row a
/// distance. Errors (usage): unknown method or option; those of Stage.
[[nodiscard]] std::string zoom_table(Scene scene, const std::string& methods, const std::vector<double>& distances,
                                     int rounds);

}  // namespace footprint::bench
