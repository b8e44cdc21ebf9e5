// Maps on which the simple lobes' errors are known: none, or those of two slopes in closed form.
#include "renderer/bake/map_statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "renderer/core/error.hpp"

namespace footprint {
namespace {

// Columns of slopes +s and -s along x.
Image grooves(float s) {
  Image map(16, 16, 4, 1.0F);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      map.at(x, y)[0] = x % 2 == 0 ? -s : s;
      map.at(x, y)[1] = 0.0F;
    }
  }
  return map;
}

Image alpha(float value) { return {1, 1, 1, value}; }

TEST(LobeErrors, AFlatMapHasNone) {
  for (const double error : lobe_errors(grooves(0.0F), alpha(0.2F), 2)) EXPECT_NEAR(error, 0.0, 1e-12);
}

TEST(LobeErrors, OneTexelIsExact) {
  for (const double error : lobe_errors(grooves(0.4F), alpha(0.2F), 0)) EXPECT_NEAR(error, 0.0, 1e-12);
}

// Every block of 2 x 2 texels has the same two slopes, so the sums are over the two half vectors alone.
TEST(LobeErrors, GroovesHaveTheErrorsOfTwoSlopes) {
  constexpr double s = 0.25, a = 0.2;
  const auto density = [](double x, double y, double xx, double yy) {
    const double q = x * x / xx + y * y / yy;
    return 1.0 / (std::numbers::pi * std::sqrt(xx * yy) * (1.0 + q) * (1.0 + q));
  };
  double mean = 0;
  LobeErrors squares{};
  for (const auto& [x, y] : {std::pair{0.1255, 0.0992}, std::pair{-0.2807, 0.3898}}) {
    const double plus = density(x - s, y, a * a, a * a), minus = density(x + s, y, a * a, a * a);
    const double exact = 0.5 * (plus + minus);
    mean += exact / 2;
    squares[0] += std::pow(plus - exact, 2) / 2;  // as far as from the other
    squares[1] += std::pow(density(x, y, a * a, a * a) - exact, 2) / 2;
    squares[2] += std::pow(density(x, y, a * a + s * s, a * a + s * s) - exact, 2) / 2;
    squares[3] += std::pow(density(x, y, a * a + 2 * s * s, a * a) - exact, 2) / 2;
  }
  const LobeErrors errors = lobe_errors(grooves(static_cast<float>(s)), alpha(static_cast<float>(a)), 1);
  for (std::size_t i = 0; i < errors.size(); ++i) EXPECT_NEAR(errors.at(i), std::sqrt(squares.at(i)) / mean, 1e-6) << i;
}

TEST(LobeErrors, AMapOfAlphasCountsPerTexel) {
  const Image constant(16, 16, 1, 0.3F);
  EXPECT_EQ(lobe_errors(grooves(0.4F), constant, 2), lobe_errors(grooves(0.4F), alpha(0.3F), 2));
  Image varied = constant;
  for (int y = 0; y < 16; ++y) varied.at(3, y)[0] = 0.05F;
  EXPECT_NE(lobe_errors(grooves(0.4F), varied, 2), lobe_errors(grooves(0.4F), constant, 2));
}

TEST(LobeErrors, RefusesAlphasOfAnotherSize) {
  EXPECT_THROW((void)lobe_errors(grooves(0.4F), Image(8, 8, 1, 0.3F), 1), Error);
}

}  // namespace
}  // namespace footprint
