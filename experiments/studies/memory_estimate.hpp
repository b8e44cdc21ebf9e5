// How much memory the maps of a scene take, before they take it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

#include "renderer/effects/effects.hpp"

namespace footprint {

/// Bytes. What methods and the reference read is 32-bit floats; a material keeps its maps at their own depth.
struct MemoryEstimate {
  std::uint64_t maps = 0;    ///< the scene's maps as 32-bit floats, each once however many materials share it
  std::uint64_t kept = 0;    ///< what is kept of them: texels at their own depth
  std::uint64_t shared = 0;  ///< mip chains that every method reads
  std::uint64_t reference = 0;
  std::vector<std::uint64_t> methods;  ///< of each: mip chains of what it keeps of normals, and of widths
  std::uint64_t bake = 0;              ///< of the largest map, while its chain is made
  std::uint64_t upload = 0;            ///< of the largest map, while it lies in memory and on the GPU

  /// With all of the methods, what is kept of the scene's own maps included.
  [[nodiscard]] std::uint64_t peak() const {
    // The last method's chains are made before the reference's maps are there.
    const std::uint64_t all = std::accumulate(methods.begin(), methods.end(), std::uint64_t{0});
    const std::uint64_t last = methods.empty() ? 0 : methods.back();
    return kept + shared + std::max(all - last + bake, all + reference + upload);
  }
};

/// Of a scene that is loaded, with methods that keep so many channels of a texel of normals
/// (MethodInfo::normal_chain_channels; none: taken for LEAN's, though some keep far more). Pure arithmetic over the
/// sizes of its maps.
[[nodiscard]] MemoryEstimate estimate_memory(const Scene& scene, const EffectSet& effects,
                                             std::span<const std::optional<int>> normal_chain_channels);

}  // namespace footprint
