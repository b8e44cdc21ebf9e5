// The frames of a zoom.
#pragma once

#include <vector>

namespace footprint {

/// `frames` (2 or more) factors on the camera's distance from `from` to `to` (above 0), at equal ratios: each step
/// looks like the one before.
[[nodiscard]] std::vector<double> zoom_distances(double from, double to, int frames);

}  // namespace footprint
