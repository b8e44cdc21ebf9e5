// Bins: golden indices, equal solid angle, packed normals that stay in their bin.
#include "methods/atanasov_bins/inverse_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "renderer/microgeometry/direction_grid.hpp"
#include "tests/methods/bins_twin.hpp"

namespace footprint::atanasov_bins {
namespace {

using testing::bin_of;

glm::dvec3 random_direction(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const double z = unit(random), angle = 2.0 * std::numbers::pi * unit(random);
  return {std::sqrt(1.0 - z * z) * std::cos(angle), std::sqrt(1.0 - z * z) * std::sin(angle), z};
}

TEST(Bins, HaveTheGoldenIndices) {
  struct Golden {
    glm::dvec3 direction;
    std::uint32_t of_5, of_127;
  };
  for (const Golden& golden : {Golden{{0.0, 0.0, 1.0}, 12, 8064},
                               {{0.3, 0.1, 0.9}, 13, 8841},
                               {{-0.5, 0.2, 0.6}, 16, 10064},
                               {{0.1, -0.7, 0.4}, 2, 2357},
                               {{-0.2, -0.3, 0.9}, 6, 5892},
                               {{0.9, 0.1, 0.05}, 14, 9269}}) {
    const glm::dvec3 h = glm::normalize(golden.direction);
    EXPECT_EQ(bin_of(h, 5), golden.of_5) << h.x;
    EXPECT_EQ(bin_of(h, 127), golden.of_127) << h.x;
    EXPECT_EQ(bin_of_packed(packed_normal(h, 5), 5), golden.of_5) << h.x;
    EXPECT_EQ(bin_of_packed(packed_normal(h, 127), 127), golden.of_127) << h.x;
  }
}

// At the horizon a coordinate of the square is 1.
TEST(Bins, HoldTheHorizonAndWhatIsBelow) {
  for (const int m : {1, 2, 63, 255, 2047}) {
    for (int i = 0; i < 64; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / 64.0;
      for (const double z : {0.0, -0.3}) {
        const glm::dvec3 n = glm::normalize(glm::dvec3(std::cos(angle), std::sin(angle), z));
        const std::uint32_t bin = bin_of_packed(packed_normal(n, m), m);
        EXPECT_LT(bin, static_cast<std::uint32_t>(m) * static_cast<std::uint32_t>(m));
        EXPECT_EQ(bin, bin_of(glm::normalize(glm::dvec3(n.x, n.y, 0.0)), m)) << m << " " << i << " " << z;
      }
    }
  }
}

// Evenly spread directions fill all bins evenly: chi-squared is within five of its standard deviations.
TEST(Bins, HaveEqualSolidAngle) {
  constexpr int m = 31;
  constexpr int samples = 1'000'000;
  std::vector<double> counts(static_cast<std::size_t>(m * m), 0.0);
  std::mt19937 random(5);
  for (int i = 0; i < samples; ++i) counts[bin_of(random_direction(random), m)] += 1.0;
  constexpr double expected = static_cast<double>(samples) / (m * m);
  double chi2 = 0.0;
  for (const double count : counts) chi2 += (count - expected) * (count - expected) / expected;
  const double freedom = m * m - 1.0;
  EXPECT_LT(std::abs(chi2 - freedom), 5.0 * std::sqrt(2.0 * freedom));
  EXPECT_DOUBLE_EQ(bin_solid_angle(m) * m * m, 2.0 * std::numbers::pi);
}

TEST(Bins, PackedNormalsStayInTheirBinAndNearThemselves) {
  std::mt19937 random(9);
  for (const int m : {1, 2, 5, 63, 127, 255, 1000, 2047}) {
    for (int i = 0; i < 20000; ++i) {
      const glm::dvec3 n = random_direction(random);
      const std::uint32_t packed = packed_normal(n, m);
      ASSERT_EQ(bin_of_packed(packed, m), bin_of(n, m)) << m;
      ASSERT_LT(glm::length(square_to_hemisphere(place_in_square(packed)) - n), 1e-4) << m;
    }
  }
}

// The corner of the square is a direction; its places are all ones.
TEST(Bins, NoNormalIsTakenForAnInvalidOne) {
  const glm::dvec3 corner = square_to_hemisphere({1.0, 1.0});
  for (const int m : {1, 127, 2047}) EXPECT_NE(packed_normal(corner, m), no_normal);
}

TEST(Bins, AcrossALobeAreAsWideAsRequested) {
  const double variance = 0.5 * 0.1 * 0.1;
  const int m = bins_across_for(variance, 0.7, 2047);
  EXPECT_EQ(m % 2, 1);
  const double width = std::sqrt(bin_solid_angle(m));
  EXPECT_LE(width, 0.7 * std::sqrt(variance));
  EXPECT_GT(width, 0.66 * std::sqrt(variance));
  EXPECT_EQ(bins_across_for(variance, 0.7, 31), 31);
  EXPECT_EQ(bins_across_for(1e-9, 0.7, 127), 127);
  EXPECT_EQ(bins_across_for(10.0, 0.7, 127), 5);
  EXPECT_EQ(bins_across_for(10.0, 0.7, 1), 1);
}

}  // namespace
}  // namespace footprint::atanasov_bins
