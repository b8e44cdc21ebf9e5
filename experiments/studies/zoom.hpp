// The distances of a run: those that are given, the frames of a zoom, or the scene's own.
#pragma once

#include <vector>

#include "experiments/settings/run_settings.hpp"

namespace footprint {

/// `frames` (2 or more) factors on the camera's distance from `from` to `to` (above 0), at equal ratios: each step
/// looks like the one before.
[[nodiscard]] std::vector<double> zoom_distances(double from, double to, int frames);

/// Those that a run asks for, as far as they are known without its scene; empty: the scene decides.
[[nodiscard]] std::vector<double> given_distances(const ViewSettings& view);

/// Those of a run over `scene`, one or more. Errors (usage): a zoom that ends where it starts.
[[nodiscard]] std::vector<double> run_distances(const ViewSettings& view, const Scene& scene);

}  // namespace footprint
