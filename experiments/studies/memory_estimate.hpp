// How much memory the maps of a scene take, before they take it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "renderer/effects/effects.hpp"

namespace footprint {

/// Bytes, for 32-bit floats all along.
struct MemoryEstimate {
  std::uint64_t maps = 0;    ///< the scene's decoded maps, each once however many materials share it
  std::uint64_t shared = 0;  ///< mip chains that every method reads
  std::uint64_t reference = 0;
  std::uint64_t a_method = 0;  ///< mip chains of mean normals and of widths, what most methods keep; some keep far more
  std::uint64_t bake = 0;      ///< of the largest map, while its chain is made

  /// With so many methods, the scene's own maps included.
  [[nodiscard]] std::uint64_t peak(std::size_t methods) const {
    return maps + shared + reference + methods * a_method + bake;
  }
};

/// Of a scene that is loaded. Pure arithmetic over the sizes of its maps.
[[nodiscard]] MemoryEstimate estimate_memory(const Scene& scene, const EffectSet& effects);

}  // namespace footprint
