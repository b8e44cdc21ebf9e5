// Time and memory of bakes, and limits on them.
#pragma once

#include <string>

#include "bench/bench_scene.hpp"

namespace footprint::bench {

/// The most that every bake may take; 0: no limit.
struct BakeLimits {
  double seconds = 0.0;    ///< wall clock of the quickest of all rounds: other load on the machine only adds to it
  double gigabytes = 0.0;  ///< 1e9 bytes: the process' peak, the scene that is baked included
};

/// A table of the bakes of a scene by methods of a list, `rounds` times each: wall clock and CPU time of the quickest
/// round, bytes, and the peak memory of the process until then. Errors (check): a bake takes more than it may,
/// with the table before it on stdout.
void print_bake_table(const Scene& scene, const std::string& methods, int rounds, const BakeLimits& limits);

}  // namespace footprint::bench
