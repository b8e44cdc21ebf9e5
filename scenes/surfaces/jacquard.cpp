// The figure and the binding of a satin decide which thread is on top at a crossing.
#include "scenes/surfaces/jacquard.hpp"

#include <cmath>
#include <numbers>

#include "renderer/core/numbers.hpp"
#include "scenes/surfaces/texel_grid.hpp"

namespace footprint {
namespace {

/// Whether a flower of six petals around a disc covers a point; 1 is the tip of a petal.
bool in_flower(const glm::dvec2& point) {
  const double radius = glm::length(point), angle = std::atan2(point.y, point.x);
  if (radius < 0.16) return true;
  if (radius < 0.24) return false;
  const double petal = std::abs(std::cos(3.0 * angle));
  const bool vein = petal > 0.985 && radius > 0.4 && radius < 0.85;
  return radius < 0.3 + 0.7 * petal && !vein;
}

/// Whether the figure covers a point of its repeat, both coordinates within -1 to 1: ovals that touch at the repeat's
/// corners and middles of sides, a band around each, leaves where they meet.
bool in_figure(const glm::dvec2& point) {
  const auto oval = [](const glm::dvec2& at) {
    // Pointed at top and bottom: the bounding wave swings from side to side.
    return std::abs(at.x) - 0.5 * (1.0 + std::cos(std::numbers::pi * at.y));
  };
  const double edge = oval(point);
  if (std::abs(edge + 0.02) < 0.055) return true;
  if (std::abs(edge + 0.17) < 0.02) return true;
  if (edge < -0.19) return in_flower(point / glm::dvec2{0.62, 0.5});
  // Between the ovals are those of the neighbouring rows, half a repeat away.
  const glm::dvec2 other{point.x - std::copysign(1.0, point.x), point.y - std::copysign(1.0, point.y)};
  if (std::abs(oval(other) + 0.17) < 0.02) return true;
  return oval(other) < -0.19 && in_flower(other / glm::dvec2{0.62, 0.5});
}

/// Whether a crossing is a binding point of a satin of five, which shifts by two threads per row.
bool is_binding(int column, int row) { return wrap(column - 2 * row, 5) == 0; }

}  // namespace

Jacquard::Jacquard(glm::ivec2 threads, glm::ivec2 figures, std::uint32_t seed) : threads_(threads), figures_(figures) {
  std::mt19937_64 random(seed);
  for (int i = 0; i < threads.x; ++i) warp_.push_back(uniform(random));
  for (int i = 0; i < threads.y; ++i) weft_.push_back(uniform(random));
}

Thread Jacquard::at(const glm::dvec2& uv) const {
  const glm::dvec2 cell = uv * glm::dvec2(threads_);
  const int column = static_cast<int>(std::floor(cell.x)), row = static_cast<int>(std::floor(cell.y));
  // A crossing is one thread or the other, so that the figure's outline has steps.
  const glm::dvec2 crossing = (glm::dvec2(column, row) + 0.5) / glm::dvec2(threads_);
  const glm::dvec2 repeat = glm::fract(crossing * glm::dvec2(figures_));
  Thread thread;
  thread.figure = in_figure(2.0 * repeat - 1.0);
  thread.weft = thread.figure != is_binding(column, row);
  const glm::dvec2 offset = 2.0 * (cell - glm::dvec2(column, row)) - 1.0;
  thread.across = thread.weft ? offset.y : offset.x;
  thread.along = thread.weft ? offset.x : offset.y;
  const auto uneven = [](const std::vector<double>& threads, int index) {
    return threads[static_cast<std::size_t>(wrap(index, static_cast<int>(threads.size())))];
  };
  thread.uneven = thread.weft ? uneven(weft_, row) : uneven(warp_, column);
  return thread;
}

glm::dvec3 Jacquard::normal(const Thread& thread, double roundness) {
  // A thread is round across its width; along its length it dives at its ends, the binding points.
  const double across = roundness * thread.across, along = 0.35 * roundness * thread.along;
  const glm::dvec2 tilt = thread.weft ? glm::dvec2{along, across} : glm::dvec2{across, along};
  return glm::dvec3{tilt, std::sqrt(std::max(0.0, 1.0 - glm::dot(tilt, tilt)))};
}

glm::dvec3 silk_color(const Thread& thread, const glm::dvec3& warp, const glm::dvec3& weft, double edge_shade) {
  const double shade = (1.0 - edge_shade * thread.across * thread.across) * (0.8 + 0.4 * thread.uneven);
  return glm::min(shade * (thread.weft ? weft : warp), 1.0);
}

double silk_exponent(const Thread& thread, double warp, double weft) {
  return (thread.weft ? weft : warp) * std::exp2(2.0 * thread.uneven - 1.0);
}

}  // namespace footprint
