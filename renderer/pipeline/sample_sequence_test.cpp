// The sequences' elementary intervals, what pairs are worth together, and the shaders' twin of the scrambling.
#include "renderer/pipeline/sample_sequence.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "tests/support/shader_probe.hpp"

namespace footprint::testing {
namespace {

constexpr std::array pairs{SamplePair::pixel, SamplePair::texel, SamplePair::light, SamplePair::lobe,
                           SamplePair::choice};

struct Point {
  std::uint32_t x, y;  // fixed point in [0, 1)
};

Point point_of(SamplePair pair, std::uint32_t index, std::uint32_t seed) {
  const glm::uvec2 digits = sample_digits(pair, index);
  return {scrambled(digits.x, combined_seed(seed, 0)), scrambled(digits.y, combined_seed(seed, 1))};
}

// Whether 2^m points put one into each of the 2^-a by 2^(a - m) boxes, for every a: the definition.
bool is_net(const std::vector<Point>& points, unsigned m) {
  for (unsigned a = 0; a <= m; ++a) {
    std::vector<bool> filled(points.size(), false);
    for (const Point& p : points) {
      const std::uint64_t column = (std::uint64_t{p.x} << a) >> 32U, row = (std::uint64_t{p.y} << (m - a)) >> 32U;
      filled[(row << a) + column] = true;
    }
    if (std::find(filled.begin(), filled.end(), false) != filled.end()) return false;
  }
  return true;
}

TEST(SampleSequence, EveryPairIsANetInBaseTwo) {
  for (const SamplePair pair : pairs) {
    for (const unsigned m : {1U, 2U, 5U, 8U, 12U}) {
      for (const std::uint32_t block : {0U, 1U, 5U}) {
        for (const std::uint32_t seed : {1U, 77U, 0xfffffff0U}) {
          std::vector<Point> points;
          for (std::uint32_t i = 0; i < 1U << m; ++i) points.push_back(point_of(pair, (block << m) + i, seed));
          EXPECT_TRUE(is_net(points, m)) << static_cast<int>(pair) << ", " << m << ", " << block << ", " << seed;
        }
      }
    }
  }
}

// The check can fail: independent points are none, and neither is a sequence with its index as both coordinates.
TEST(SampleSequence, OtherPointsAreNoNet) {
  std::mt19937 random(3);
  std::vector<Point> independent, diagonal;
  for (std::uint32_t i = 0; i < 64; ++i) {
    independent.push_back({static_cast<std::uint32_t>(random()), static_cast<std::uint32_t>(random())});
    const Point p = point_of(SamplePair::pixel, i, 1);
    diagonal.push_back({p.x, p.x});
  }
  EXPECT_FALSE(is_net(independent, 6));
  EXPECT_FALSE(is_net(diagonal, 6));
}

// Sobol's own first points: 0, 1/2, 1/4, 3/4, ... and 0, 1/2, 3/4, 1/4, 5/8, ...
TEST(SampleSequence, PixelsFollowSobolsTable) {
  constexpr std::array<double, 8> x{0, 0.5, 0.25, 0.75, 0.125, 0.625, 0.375, 0.875};
  constexpr std::array<double, 8> y{0, 0.5, 0.75, 0.25, 0.625, 0.125, 0.375, 0.875};
  const auto value = [](std::uint32_t digits) {
    double sum = 0;
    for (unsigned i = 0; i < 32; ++i) sum += (digits >> i & 1U) * std::ldexp(0.5, -static_cast<int>(i));
    return sum;
  };
  for (std::uint32_t i = 0; i < 8; ++i) {
    EXPECT_EQ(value(sample_digits(SamplePair::pixel, i).x), x.at(i));
    EXPECT_EQ(value(sample_digits(SamplePair::pixel, i).y), y.at(i));
  }
}

// What a draw hands to the shaders rests on it: the points of an aligned block are its first one's with those of the
// first block, added without carry. Of a block that is not aligned they are others.
TEST(SampleSequence, AnAlignedBlockIsTheFirstOneAdded) {
  const auto added = [](SamplePair pair, std::uint32_t block, std::uint32_t step) {
    const glm::uvec2 a = sample_digits(pair, block), b = sample_digits(pair, step);
    return std::pair(a.x ^ b.x, a.y ^ b.y);
  };
  const auto whole = [](SamplePair pair, std::uint32_t index) {
    const glm::uvec2 digits = sample_digits(pair, index);
    return std::pair(digits.x, digits.y);
  };
  for (const SamplePair pair : pairs) {
    for (const std::uint32_t block : {0U, 16U, 48U, 4080U, 4096U, 65520U}) {
      for (std::uint32_t step = 0; step < 16; ++step)
        EXPECT_EQ(added(pair, block, step), whole(pair, block + step)) << static_cast<int>(pair) << ", " << block;
    }
    EXPECT_NE(added(pair, 8, 8), whole(pair, 16)) << static_cast<int>(pair);
  }
}

// Root mean square error, over scramblings, of the integral of an indicator that cuts across all four dimensions of
// pixel and another pair: whether x + u >= 1 in both, as a bilinear filter draws its texel. The exact value is 1/4.
double error_together(SamplePair pair, std::uint32_t count, bool apart) {
  double squares = 0;
  constexpr std::uint32_t seeds = 400;
  for (std::uint32_t seed = 0; seed < seeds; ++seed) {
    int inside = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      const Point p = point_of(SamplePair::pixel, i, seed);
      const Point q = point_of(pair, apart ? combined_seed(i, seed + 9000) : i, seed + 1000);
      inside += (std::uint64_t{p.x} + q.x) >> 32U && (std::uint64_t{p.y} + q.y) >> 32U ? 1 : 0;
    }
    squares += std::pow(inside / static_cast<double>(count) - 0.25, 2);
  }
  return std::sqrt(squares / seeds);
}

TEST(SampleSequence, PairsFillFourDimensionsTogether) {
  for (const SamplePair pair : {SamplePair::texel, SamplePair::light, SamplePair::lobe}) {
    for (const std::uint32_t count : {64U, 256U}) {
      EXPECT_LT(error_together(pair, count, false), (count == 64U ? 0.65 : 0.5) * error_together(pair, count, true))
          << static_cast<int>(pair) << ", " << count;
    }
  }
}

// Bits of the scrambled coordinate, over seeds: each digit is 0 or 1 equally often, and two next to one another agree
// half of the time.
TEST(SampleSequence, ScramblingIsEven) {
  constexpr int seeds = 20000;
  for (const std::uint32_t index : {0U, 1U, 6U, 37U}) {
    std::array<int, 16> ones{}, same{};
    for (std::uint32_t seed = 0; seed < seeds; ++seed) {
      const Point p = point_of(SamplePair::pixel, index, seed);
      for (unsigned digit = 0; digit < 16; ++digit) {
        const std::uint32_t bits = p.y >> (30U - digit) & 3U;
        ones.at(digit) += static_cast<int>(bits >> 1U);
        same.at(digit) += bits == 0U || bits == 3U ? 1 : 0;
      }
    }
    constexpr double deviation = 71.0;  // of a fair count of so many
    for (std::size_t digit = 0; digit < 16; ++digit) {
      EXPECT_NEAR(ones.at(digit), seeds / 2, 5 * deviation) << index << ", " << digit;
      EXPECT_NEAR(same.at(digit), seeds / 2, 5 * deviation) << index << ", " << digit;
    }
  }
}

TEST(SampleSequence, ShadersMeetTheirTwins) {
  std::vector<std::array<glm::vec4, 3>> inputs;
  std::vector<float> expected;
  std::mt19937 random(11);
  for (int i = 0; i < 200; ++i) {
    const std::array<std::uint32_t, 4> halves{
        static_cast<std::uint32_t>(random()) >> 16U, static_cast<std::uint32_t>(random()) >> 16U,
        static_cast<std::uint32_t>(random()) >> 16U, static_cast<std::uint32_t>(random()) >> 16U};
    inputs.push_back({glm::vec4(halves[0], halves[1], halves[2], halves[3]), {}, {}});
    expected.push_back(unit_interval(scrambled(halves[0] << 16U | halves[1], halves[2] << 16U | halves[3])));
  }
  ShaderText text({});
  text.include("sample_sequence.glsl");
  const auto found = evaluate_glsl(
      text.text(),
      "uvec4 u = uvec4(a); return vec4(unitInterval(scrambled(u.x << 16u | u.y, u.z << 16u | u.w)), 0.0, 0.0, 0.0);",
      inputs);
  for (std::size_t i = 0; i < inputs.size(); ++i) EXPECT_EQ(found[i].x, expected[i]) << i;
}

}  // namespace
}  // namespace footprint::testing
