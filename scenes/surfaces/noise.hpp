// Gradient noise that repeats, with its exact gradient (Perlin, "Improving Noise", 2002: quintic interpolation), and
// sums of its octaves.
#pragma once

#include <glm/glm.hpp>
#include <random>
#include <span>
#include <vector>

#include "scenes/surfaces/height.hpp"
#include "scenes/surfaces/texel_grid.hpp"

namespace footprint {

/// Smooth noise with about one hill or hollow per cell; values are within about -0.7 to 0.7, with mean 0.
class PeriodicNoise {
 public:
  /// Repeats after `period` >= 1 cells each way. The gradients at the cells' corners are drawn from `random`.
  PeriodicNoise(int period, std::mt19937_64& random);

  /// At (x, y), in cells.
  [[nodiscard]] Height at(const Height& x, const Height& y) const;

 private:
  WrappedGrid<glm::dvec2> corners_;  ///< unit gradients
};

/// One octave: noise cells along the map's width, and its strength.
struct Octave {
  int cells;
  double strength;
};

/// Octaves of gradient noise over the unit square, repeated beyond it.
class OctaveNoise {
 public:
  OctaveNoise(std::span<const Octave> octaves, std::mt19937_64& random) : octaves_(octaves.begin(), octaves.end()) {
    for (const Octave& octave : octaves_) noises_.emplace_back(octave.cells, random);
  }

  /// The sum of the octaves weighted by strength; about as large as the strongest.
  [[nodiscard]] double value(const glm::dvec2& uv) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < noises_.size(); ++i) sum += octaves_[i].strength * at(i, HeightPoint{uv}).value();
    return sum;
  }

  /// A height in map widths: the sum of the octaves, each with a slope of about its strength.
  [[nodiscard]] Height relief(const HeightPoint& point) const {
    Height sum{0.0};
    for (std::size_t i = 0; i < noises_.size(); ++i) sum += octaves_[i].strength / octaves_[i].cells * at(i, point);
    return sum;
  }

 private:
  [[nodiscard]] Height at(std::size_t octave, const HeightPoint& point) const {
    const double cells = octaves_[octave].cells;
    return noises_[octave].at(cells * point.x, cells * point.y);
  }

  std::vector<Octave> octaves_;
  std::vector<PeriodicNoise> noises_;
};

/// The normals of the relief of some octaves, with slopes multiplied by the surface's parameter `steepness`.
[[nodiscard]] Image relief_normals(const SurfaceSettings& settings, std::span<const Octave> octaves);

}  // namespace footprint
