// Gradient noise with Perlin's quintic fade; its slope follows from the same lookup by the chain rule.
#include "scenes/surfaces/height.hpp"

#include <cmath>
#include <numbers>

#include "renderer/core/numbers.hpp"

namespace footprint {
namespace {

double fade(double t) { return t * t * t * (t * (6.0 * t - 15.0) + 10.0); }

double fade_slope(double t) { return 30.0 * t * t * (t - 1.0) * (t - 1.0); }

}  // namespace

PeriodicNoise::PeriodicNoise(int period, std::mt19937_64& random) : corners_(period, period) {
  for (glm::dvec2& gradient : corners_) {
    const double angle = 2.0 * std::numbers::pi * uniform(random);
    gradient = {std::cos(angle), std::sin(angle)};
  }
}

Height PeriodicNoise::at(const Height& x, const Height& y) const {
  const int column = static_cast<int>(std::floor(x.value())), row = static_cast<int>(std::floor(y.value()));
  const glm::dvec2 t{x.value() - column, y.value() - row};
  const glm::dvec2 &g00 = corners_.at(column, row), &g10 = corners_.at(column + 1, row);
  const glm::dvec2 &g01 = corners_.at(column, row + 1), &g11 = corners_.at(column + 1, row + 1);
  const double v00 = glm::dot(g00, t), v10 = glm::dot(g10, t - glm::dvec2{1.0, 0.0});
  const double v01 = glm::dot(g01, t - glm::dvec2{0.0, 1.0}), v11 = glm::dot(g11, t - glm::dvec2{1.0, 1.0});
  const double a = fade(t.x), b = fade(t.y);
  const double twist = v00 - v10 - v01 + v11;
  const double value = v00 + a * (v10 - v00) + b * (v01 - v00) + a * b * twist;
  const glm::dvec2 mixed = g00 + a * (g10 - g00) + b * (g01 - g00) + a * b * (g00 - g10 - g01 + g11);
  const double by_x = mixed.x + fade_slope(t.x) * (v10 - v00 + b * twist);
  const double by_y = mixed.y + fade_slope(t.y) * (v01 - v00 + a * twist);
  return {value, by_x * x.derivatives() + by_y * y.derivatives()};
}

Image relief_normals(const SurfaceSettings& settings, std::span<const Octave> octaves) {
  std::mt19937_64 random(settings.seed);
  const OctaveNoise noise(octaves, random);
  const double steepness = settings.parameters.number("steepness");
  return fill_normals(settings.resolution, [&](const glm::dvec2& uv) {
    return normal_of_slope(steepness * slope_of(noise.relief(HeightPoint{uv})));
  });
}

}  // namespace footprint
