// Benchmarks of editing small-scale geometry: from a patch to the amplitudes of its lobes.
#pragma once

namespace footprint::bench {

/// One edit of each kind of patch at the paper's discretisation, and how it grows with facets and normals.
void register_iwasaki_benchmarks();

}  // namespace footprint::bench
