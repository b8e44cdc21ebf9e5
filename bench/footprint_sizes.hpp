// What a frame costs by the size of its pixels' footprints on one large map.
#pragma once

#include <string>

namespace footprint::bench {

/// Prints, for frames of 512 x 512 pixels by methods of a list, commas between, of a plane that repeats the map of the
/// surface `scratched_metal`, `resolution` texels a side, under one light: what they cost where every pixel's footprint
/// is a square of 1, 2, 4 ... texels a side, up to the whole map. CPU times, medians over `repeats` rounds, with the
/// lookups per pixel, and the greatest over the median of all sizes of both. Errors (usage): unknown method or option;
/// (check): of one of the methods the greatest time is more than `most_ratio` times the median (0: whatever it is).
void print_footprint_sizes(const std::string& methods, int resolution, int repeats, double most_ratio);

}  // namespace footprint::bench
