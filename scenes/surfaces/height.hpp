// Heights that carry their gradient, so that normals of formulas are exact; and gradient noise that repeats.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <random>
#include <span>
#include <unsupported/Eigen/AutoDiff>
#include <vector>

#include "scenes/surfaces/texel_grid.hpp"

namespace footprint {

/// A number and its derivatives by the two coordinates that a formula starts from.
using Height = Eigen::AutoDiffScalar<Eigen::Vector2d>;

/// The coordinates of a point, with derivative 1 by themselves.
struct HeightPoint {
  explicit HeightPoint(const glm::dvec2& point) : x(point.x, 2, 0), y(point.y, 2, 1) {}
  Height x, y;
};

/// The gradient of a height.
[[nodiscard]] inline glm::dvec2 slope_of(const Height& height) {
  return {height.derivatives()[0], height.derivatives()[1]};
}

/// 0 below `low`, 1 above `high`, 3 t^2 - 2 t^3 between them; low < high.
[[nodiscard]] inline Height smooth_step(const Height& x, double low, double high) {
  if (x.value() <= low) return Height{0.0};
  if (x.value() >= high) return Height{1.0};
  const Height t = (x - low) / (high - low);
  return t * t * (3.0 - 2.0 * t);
}

/// 1 from `low` to `high`, falling smoothly to 0 over `edge` within them.
[[nodiscard]] inline Height smooth_band(const Height& x, double low, double high, double edge) {
  return smooth_step(x, low, low + edge) * (1.0 - smooth_step(x, high - edge, high));
}

/// A round ridge: (1 + cos(pi t)) / 2 for |t| < 1, else 0.
[[nodiscard]] inline Height smooth_ridge(const Height& t) {
  if (std::abs(t.value()) >= 1.0) return Height{0.0};
  return 0.5 + 0.5 * cos(std::numbers::pi * t);
}

/// A wave of period 1 in `phase`, as high as a slope of up to about `slope` needs.
[[nodiscard]] inline Height engraved_wave(const Height& phase, double period, double slope) {
  return slope * period / (2.0 * std::numbers::pi) * cos(2.0 * std::numbers::pi * phase);
}

/// The larger of two heights, with its gradient.
[[nodiscard]] inline Height higher(const Height& a, const Height& b) { return a.value() >= b.value() ? a : b; }

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
