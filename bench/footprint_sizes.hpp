// The cost of a frame by the size of its pixels' footprints on one large map.
#pragma once

#include <string>

namespace footprint::bench {

/// Prints, for frames of 512 x 512 pixels by methods of a list, commas between, of a plane that repeats the map of the
/// surface `scratched_metal`, `resolution` texels per side, under one light: what they cost where every pixel's
/// footprint is a square of 1, 2, 4 ... texels per side, up to the whole map. CPU times, medians over `repeats` rounds,
/// with the lookups per pixel, and the greatest over the median of all sizes of both. Errors (usage): unknown method or
/// option; (check): the greatest time of a method is more than `most_ratio` times its median (0: no limit).
void print_footprint_sizes(const std::string& methods, int resolution, int repeats, double most_ratio);

}  // namespace footprint::bench
