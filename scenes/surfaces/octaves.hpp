// Sums of periodic noise: relief and stains of several widths at once.
#pragma once

#include <random>
#include <span>
#include <vector>

#include "scenes/surfaces/height.hpp"
#include "scenes/surfaces/noise.hpp"

namespace footprint {

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

  /// Octaves weighed by strength: values, of about the size of the strongest.
  [[nodiscard]] double value(const glm::dvec2& uv) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < noises_.size(); ++i) sum += octaves_[i].strength * at(i, HeightPoint{uv}).value();
    return sum;
  }

  /// Octaves whose slope is of about their strength: a height in widths of the map.
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

}  // namespace footprint
