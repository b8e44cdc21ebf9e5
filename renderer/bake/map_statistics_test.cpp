// Maps whose statistics are known in closed form.
#include "renderer/bake/map_statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "renderer/core/error.hpp"

namespace footprint {
namespace {

Image map_of(int width, int height, const std::function<glm::dvec2(int, int)>& slope) {
  Image map(width, height, 4);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const glm::dvec3 n = glm::normalize(glm::dvec3(-slope(x, y), 1.0));
      const auto texel = map.at(x, y);
      for (int c = 0; c < 3; ++c) texel[static_cast<std::size_t>(c)] = static_cast<float>(n[c]);
      texel[3] = 1.0F;
    }
  }
  return map;
}

TEST(MapStatistics, AFlatMapHasNoSpread) {
  const auto levels = map_statistics(map_of(8, 16, [](int, int) { return glm::dvec2(0.3, -0.2); }));
  ASSERT_EQ(levels.size(), 3U);
  for (const LevelStatistics& level : levels) {
    EXPECT_NEAR(level.resultant, 1.0, 1e-12);
    EXPECT_NEAR(level.variance, 0.0, 1e-12);
  }
}

// Columns of slope +s and -s: the mean normal has the length cos(atan s), the variance s^2 lies on one axis, and two
// slopes have the fourth moment s^4, a third of a Gaussian's.
TEST(MapStatistics, GroovesAreALineOfTwoSlopes) {
  constexpr double s = 0.5;
  const auto levels = map_statistics(map_of(16, 16, [](int x, int) { return glm::dvec2(x % 2 == 0 ? s : -s, 0.0); }));
  for (const LevelStatistics& level : levels) {
    EXPECT_NEAR(level.resultant, 1.0 / std::sqrt(1.0 + s * s), 1e-6);
    EXPECT_NEAR(level.variance, 0.5 * s * s, 1e-6);
    EXPECT_NEAR(level.anisotropy, 1.0, 1e-6);
    EXPECT_NEAR(level.tails, 1.0 / 3.0, 1e-5);
  }
}

// One steep texel in 64: variance s^2 (1 - p) p and fourth moment s^4 p (1 - p) (1 - 3 p (1 - p)), with p = 1/64.
TEST(MapStatistics, RareSteepTexelsHaveHeavyTails) {
  const Image map =
      map_of(8, 8, [](int x, int y) { return x == 3 && y == 5 ? glm::dvec2(1.0, 0.0) : glm::dvec2(0.0); });
  const LevelStatistics whole = map_statistics(map).back();
  constexpr double p = 1.0 / 64.0, q = p * (1.0 - p);
  EXPECT_NEAR(whole.variance, 0.5 * q, 1e-8);
  EXPECT_NEAR(whole.tails, q * (1.0 - 3.0 * q) / (3.0 * q * q), 1e-4);
}

TEST(MapStatistics, TexelsWithoutADirectionDoNotCount) {
  Image map = map_of(4, 4, [](int x, int) { return glm::dvec2(x == 0 ? 5.0 : 0.0, 0.0); });
  for (int y = 0; y < 4; ++y) map.at(0, y)[3] = 0.0F;
  EXPECT_NEAR(map_statistics(map).back().variance, 0.0, 1e-12);
}

// (0, 0, 1), a unit vector into the surface, a grey and the unit vector (0.6, 0, 0.8).
TEST(MapStatistics, UnitVectorsOutOfTheSurfaceAreCounted) {
  Image stored(4, 1, 3);
  stored.texels = {0.5F, 0.5F, 1.0F, 0.5F, 0.5F, 0.0F, 0.5F, 0.5F, 0.5F, 0.8F, 0.5F, 0.9F};
  EXPECT_DOUBLE_EQ(unit_share(stored), 0.5);
  EXPECT_DOUBLE_EQ(unit_share(Image(4, 1, 1)), 0.0);
}

TEST(MapStatistics, CorrelationHasTheSignOfTheDependence) {
  const auto rough_left = [](int x, int y) { return glm::dvec2(x < 8 && (x + y) % 2 == 0 ? 1.0 : 0.0, 0.0); };
  const Image map = map_of(16, 16, rough_left);
  Image left(16, 16, 1), even(16, 16, 1), small(8, 8, 1);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 8; ++x) left.at(x, y)[0] = 1.0F;
  EXPECT_NEAR(correlation_with_spread(map, left, 2).value(), 1.0, 1e-9);
  for (float& value : left.texels) value = 1.0F - value;
  EXPECT_NEAR(correlation_with_spread(map, left, 2).value(), -1.0, 1e-9);
  EXPECT_FALSE(correlation_with_spread(map, even, 2));
  EXPECT_THROW((void)correlation_with_spread(map, small, 2), Error);
}

}  // namespace
}  // namespace footprint
