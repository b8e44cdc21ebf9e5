// How much memory the maps of a scene take, before they take it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "renderer/effects/effects.hpp"

namespace footprint {

/// Bytes. What methods and the reference read is 32-bit floats; a material keeps its maps at their own depth.
struct MemoryEstimate {
  std::uint64_t maps = 0;    ///< the scene's maps as 32-bit floats, each once however many materials share it
  std::uint64_t kept = 0;    ///< what is kept of them: texels at their own depth
  std::uint64_t shared = 0;  ///< mip chains that every method reads
  std::uint64_t reference = 0;
  std::uint64_t a_method = 0;  ///< mip chains of what LEAN keeps of normals, and of widths: toksvig keeps half, some
                               ///< far more
  std::uint64_t bake = 0;      ///< of the largest map, while its chain is made
  std::uint64_t upload = 0;    ///< of the largest map, while it lies in memory and on the GPU

  /// With so many methods, what is kept of the scene's own maps included.
  [[nodiscard]] std::uint64_t peak(std::size_t methods) const {
    // The last method's chains are made before the reference's maps are there.
    const std::uint64_t before = methods > 0 ? methods - 1 : 0;
    return kept + shared + std::max(before * a_method + bake, methods * a_method + reference + upload);
  }
};

/// Of a scene that is loaded. Pure arithmetic over the sizes of its maps.
[[nodiscard]] MemoryEstimate estimate_memory(const Scene& scene, const EffectSet& effects);

}  // namespace footprint
