// Benchmarks of the work before a frame, which Google Benchmark runs.
#pragma once

namespace footprint::bench {

/// Edits small-scale geometry, from a patch to the amplitudes of its lobes: each kind of patch at the paper's
/// discretisation, then more facets and normals.
void register_iwasaki_benchmarks();

/// Builds mip chains of RGBA, 32-bit floats; items are texels of the finest level.
void register_mip_benchmarks();

/// Fits Tan's mixtures to all levels of a map, four Gaussians, neighbours aligned or not; items are texels of the
/// finest level.
void register_tan_gmm_benchmarks();

}  // namespace footprint::bench
