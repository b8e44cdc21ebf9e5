// What each effect of a scene adds to a frame's time.
#pragma once

#include <vector>

#include "experiments/studies/stage.hpp"

namespace footprint {

/// Frame times with every effect of the scene and without one of them, milliseconds.
struct EffectCost {
  Effect effect = Effect::diffuse;
  double with_ms = 0, without_ms = 0;  ///< medians over the repeats
  double added_ms = 0;                 ///< median of the differences, frame by frame; noise can make it negative
};

/// Draws the stage's scene by its first method with all effects and without each one in turn, frames interleaved.
/// `run` is what the stage was made of. In the order of the enumeration, for the effects that are on.
[[nodiscard]] std::vector<EffectCost> measure_effect_costs(const Stage& stage, const RunSettings& run,
                                                           const Progress& progress);

}  // namespace footprint
