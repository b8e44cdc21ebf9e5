// A parameter of small-scale geometry that changes from frame to frame, as `--set KIND.PARAMETER=FROM:TO` writes it.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "renderer/microgeometry/patch_kinds.hpp"

namespace footprint {

/// From `from` in the first frame to `to` in the last; words are the same in both.
struct ParameterSweep {
  std::string kind, parameter;
  std::string from, to;
};

/// Reads `weave.warp_width=0.1:0.5`, or `weave.warp_width=0.3` for one value in all frames. Errors (usage): not that
/// form, an unknown kind or parameter with the nearest right one, a value that the parameter does not take.
[[nodiscard]] ParameterSweep parse_sweep(const std::string& text);

/// Errors (usage): a sweep of another kind than `kind`, a parameter set twice.
void check_sweeps(std::span<const ParameterSweep> sweeps, const PatchKind& kind);

/// The values of the swept parameters in frame `frame` of `frames` >= 1, at equal steps; whole numbers are rounded.
[[nodiscard]] std::map<std::string, std::string> values_at(std::span<const ParameterSweep> sweeps, int frame,
                                                           int frames);

}  // namespace footprint
