// What frames cost over a zoom, beside `direct` and beside as much supersampling as comes as close to the truth.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/bench_scene.hpp"

namespace footprint::bench {

/// Draws methods of a list, commas between, and `direct` at 512 x 512 at every distance: CPU milliseconds of a frame,
/// the median over `rounds`, and what they are in frames of `direct` drawn in the same rounds. With `truth_samples`
/// also the frame's error, the fewest samples of the reference whose error is no larger (EqualErrors), and what the
/// frame takes of their time, drawn in the same rounds. A text, a row a distance and method. Errors (usage): unknown
/// method or option; those of Stage and EqualErrors.
[[nodiscard]] std::string zoom_table(Scene scene, const std::string& methods, const std::vector<double>& distances,
                                     int rounds, const std::optional<int>& truth_samples = {});

}  // namespace footprint::bench
