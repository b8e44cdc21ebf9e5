// A figured cloth as a loom weaves it: the thread on top at every crossing, and its bend.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace footprint {

/// The thread on top at a point of the cloth.
struct Thread {
  bool weft = false;    ///< a weft thread, which runs along x; else a warp thread, along y
  bool figure = false;  ///< within the woven figure; else of its ground
  double across = 0.0;  ///< from the thread's middle line, -1 to 1 at its edges
  double along = 0.0;   ///< from the middle of the crossing, -1 to 1 at its ends
  double uneven = 0.0;  ///< random number of this thread, 0 to 1: the unevenness of its dye and spinning
};

/// A cloth over the unit square: `threads.x` warp and `threads.y` weft threads, multiples of five for a cloth that
/// tiles, with a whole number of `figures` each way. The ground is warp satin of five; the figure, in which weft and
/// warp change places, is a lattice of pointed ovals with a flower in each.
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

/// The colour of a thread: of the warp or the weft, darker by `edge_shade` at its edges, where it dives under its
/// neighbours.
[[nodiscard]] glm::dvec3 silk_color(const Thread& thread, const glm::dvec3& warp, const glm::dvec3& weft,
                                    double edge_shade);

/// The Blinn-Phong exponent of a thread: up to twice or half that of its kind.
[[nodiscard]] double silk_exponent(const Thread& thread, double warp, double weft);

}  // namespace footprint
