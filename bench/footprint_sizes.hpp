// What a frame costs by the size of its pixels' footprints on one large map.
#pragma once

#include <string>

namespace footprint::bench {

/// Frames of 512 x 512 pixels by methods of a list, commas between, of a plane that repeats the map of the surface
/// `scratched_metal`, `resolution` texels a side, under one light: every pixel's footprint is a square of 1, 2, 4 ...
/// texels a side, up to the whole map. A table of CPU times, medians over `repeats` rounds, with the lookups a pixel
/// and the greatest over the median of all sizes. Errors (usage): unknown method or option.
[[nodiscard]] std::string footprint_size_table(const std::string& methods, int resolution, int repeats);

}  // namespace footprint::bench
