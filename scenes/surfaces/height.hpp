// Heights that carry their gradient: a height field is written as a formula, and its normals are exact.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <unsupported/Eigen/AutoDiff>

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

}  // namespace footprint
