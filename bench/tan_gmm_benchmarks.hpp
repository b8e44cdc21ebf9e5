// Benchmarks of fitting Tan's mixtures.
#pragma once

namespace footprint::bench {

/// Registers them with Google Benchmark: all levels of a map, four Gaussians, neighbours aligned or not; items are
/// texels of the finest level.
void register_tan_gmm_benchmarks();

}  // namespace footprint::bench
