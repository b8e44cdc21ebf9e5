// A figured cloth as a loom weaves it: which of two threads lies on top at every crossing, and how it is bent there.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace footprint {

/// What lies on top at a point of the cloth.
struct Thread {
  bool weft = false;    ///< a weft thread, which runs along x; else a warp thread, along y
  bool figure = false;  ///< within the woven figure; else of its ground
  double across = 0.0;  ///< from the thread's middle line, -1 to 1 at its edges
  double along = 0.0;   ///< from the middle of the crossing, -1 to 1 at its ends
  double uneven = 0.0;  ///< of this thread alone, 0 to 1: no two are dyed and spun the same
};

/// A cloth over the unit square: `threads.x` warp and `threads.y` weft threads, multiples of five where it is to tile,
/// with a whole number of `figures` each way. The ground is warp satin of five; the figure, in which weft and warp
/// change places, is a lattice of pointed ovals with a flower in each.
class Jacquard {
 public:
  Jacquard(glm::ivec2 threads, glm::ivec2 figures, std::uint32_t seed);

  [[nodiscard]] Thread at(const glm::dvec2& uv) const;

  /// The unit normal of the round thread at that point: `roundness` is the sine of its tilt at the thread's edge.
  [[nodiscard]] static glm::dvec3 normal(const Thread& thread, double roundness);

 private:
  glm::ivec2 threads_, figures_;
  std::vector<double> warp_, weft_;  ///< Thread::uneven of each
};

}  // namespace footprint
