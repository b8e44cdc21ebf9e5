// How much memory the maps of a scene take, before they take it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "renderer/bake/bake_memory.hpp"
#include "renderer/effects/effects.hpp"

namespace footprint {

/// Bytes. What methods and the reference read is 32-bit floats; a material keeps its maps at their own depth.
struct MemoryEstimate {
  std::uint64_t maps = 0;    ///< the scene's maps as 32-bit floats, each once however many materials share it
  std::uint64_t kept = 0;    ///< what is kept of them: texels at their own depth
  std::uint64_t shared = 0;  ///< mip chains that every method reads
  std::uint64_t reference = 0;
  std::vector<BakeMemory> methods;  ///< of each: what it keeps of normals and of widths; `baking` of its largest map
  std::uint64_t shared_bake = 0;    ///< of the largest shared map, while its chain is made
  std::uint64_t upload = 0;         ///< of the largest map, while it lies in memory and on the GPU

  /// The methods in the order in which the peak is least: first those that take much while they bake and keep little
  /// of it.
  [[nodiscard]] std::vector<std::size_t> bake_order() const;

  /// With all of the methods baked in that order, what is kept of the scene's own maps included.
  [[nodiscard]] std::uint64_t peak() const;
};

/// What a method with its options takes for the normals of a material (Method::normal_memory). None: taken for LEAN's.
using NormalMemory = std::function<std::optional<BakeMemory>(const Material&)>;

/// Of a scene that is loaded. Arithmetic over the sizes of its maps.
[[nodiscard]] MemoryEstimate estimate_memory(const Scene& scene, const EffectSet& effects,
                                             std::span<const NormalMemory> methods);

}  // namespace footprint
