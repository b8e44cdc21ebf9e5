// Benchmarks of building mip chains.
#pragma once

namespace footprint::bench {

/// Registers them with Google Benchmark: RGBA, 32-bit floats; items are texels of the finest level.
void register_mip_benchmarks();

}  // namespace footprint::bench
