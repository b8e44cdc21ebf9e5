// Sample grids, tiles and timing statistics: the arithmetic around a picture.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <set>
#include <span>

#include "renderer/core/error.hpp"
#include "renderer/pipeline/sample_sequence.hpp"
#include "renderer/pipeline/timing.hpp"
#include "renderer/pipeline/view.hpp"

namespace footprint {
namespace {

// In the pixel, each from 0 to 1, of one sequence or (half -1) of both.
std::vector<glm::dvec2> all_samples(const SampleGrid& grid, int half = -1) {
  std::vector<glm::dvec2> samples;
  for (const SamplePass& pass : grid.passes) {
    if (half >= 0 && pass.half != half) continue;
    for (int y = 0; y < grid.grid; ++y) {
      for (int x = 0; x < grid.grid; ++x)
        samples.push_back((glm::dvec2(x, y) + 0.5 + pass.offset) / static_cast<double>(grid.grid));
    }
  }
  return samples;
}

TEST(SampleGrid, HasTheRequestedCountInsideThePixel) {
  for (const int spp : {1, 2, 3, 7, 16, 36, 64, 100, 127, 4096}) {
    const auto samples = all_samples(sample_grid(spp, 1));
    ASSERT_EQ(samples.size(), static_cast<std::size_t>(spp));
    for (const glm::dvec2& s : samples) EXPECT_TRUE(s.x >= 0 && s.x < 1 && s.y >= 0 && s.y < 1);
  }
}

// The samples of one sequence in `columns` x `rows` equal boxes: as many in each.
bool fill_evenly(const std::vector<glm::dvec2>& samples, int columns, int rows) {
  std::vector<std::size_t> counts(static_cast<std::size_t>(columns * rows), 0);
  for (const glm::dvec2& s : samples)
    ++counts[static_cast<std::size_t>(static_cast<int>(s.y * rows) * columns + static_cast<int>(s.x * columns))];
  return std::ranges::all_of(counts, [&](std::size_t n) { return n * counts.size() == samples.size(); });
}

// The offsets of a sequence are a (0, m, 2)-net of a cell, so that its samples are one of the pixel wherever a box is
// no longer than four cells: the grid itself is not finer.
TEST(SampleGrid, EachSequenceFillsElementaryIntervals) {
  for (const int spp : {64, 128, 256, 1024, 4096}) {
    for (const int half : {0, 1}) {
      const auto samples = all_samples(sample_grid(spp, 9), half);
      const int count = spp / 2;
      for (int columns = 4; columns <= count / 4; columns *= 2)
        EXPECT_TRUE(fill_evenly(samples, columns, count / columns)) << spp << ": " << columns;
    }
  }
  const auto both = all_samples(sample_grid(1024, 9));
  EXPECT_FALSE(fill_evenly(both, 32, 32));  // the check can fail: the two sequences know nothing of one another
}

TEST(SampleGrid, FollowsTheSeed) {
  EXPECT_EQ(all_samples(sample_grid(64, 5)), all_samples(sample_grid(64, 5)));
  EXPECT_NE(all_samples(sample_grid(64, 5)), all_samples(sample_grid(64, 6)));
  EXPECT_NE(all_samples(sample_grid(64, 5)), all_samples(sample_grid(64, 5 + (std::uint64_t{1} << 32U))));
}

TEST(SampleGrid, MoreSamplesBeginWithTheSame) {
  const SampleGrid few = sample_grid(128, 3), many = sample_grid(512, 3);
  for (const int half : {0, 1}) {
    const auto first = all_samples(few, half), all = all_samples(many, half);
    EXPECT_TRUE(std::ranges::equal(first, std::span(all).first(first.size())));
  }
}

TEST(SampleGrid, BlocksCutEachSequenceInTwo) {
  for (const int spp : {4, 64, 144, 4096}) {
    std::map<std::pair<int, int>, int> passes;
    const SampleGrid grid = sample_grid(spp, 1);
    for (const SamplePass& pass : grid.passes) ++passes[{pass.half, pass.block}];
    ASSERT_EQ(passes.size(), 4U) << spp;
    for (const auto& [block, count] : passes) EXPECT_NEAR(4.0 * count, static_cast<double>(grid.passes.size()), 3.0);
  }
}

// For a mean alone one draw will do; its samples are the first of a sequence, as evenly spread as any.
TEST(SampleGrid, TakesAsFewPassesAsRequested) {
  const SampleGrid one = sample_grid(16, 1, 1);
  EXPECT_EQ(one.grid, 4);
  EXPECT_EQ(one.passes.size(), 1U);
  EXPECT_EQ(all_samples(one), all_samples(sample_grid(16, 1, 1), 0));
  EXPECT_EQ(sample_grid(16, 1).passes.size(), 4U);
  EXPECT_EQ(sample_grid(7, 1, 1).passes.size(), 7U) << "no grid divides it";
}

TEST(SampleGrid, CellsAreNumberedOnce) {
  for (const int grid : {1, 2, 3, 4}) {
    std::set<std::uint32_t> numbers;
    for (int cell = 0; cell < grid * grid; ++cell) numbers.insert(sample_in_cell(grid, {cell % grid, cell / grid}));
    EXPECT_EQ(numbers.size(), static_cast<std::size_t>(grid * grid));
    EXPECT_LT(*numbers.rbegin(), static_cast<std::uint32_t>(grid * grid));
  }
}

// Over seeds, the means of x and y and of their product are those of an even distribution.
TEST(SampleGrid, IsUnbiased) {
  for (const int spp : {1, 7, 16}) {
    glm::dvec3 mean(0);
    constexpr int seeds = 4000;
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
      for (const glm::dvec2& s : all_samples(sample_grid(spp, seed)))
        mean += glm::dvec3(s, s.x * s.y) / static_cast<double>(spp * seeds);
    }
    EXPECT_NEAR(mean.x, 0.5, 0.015) << spp;
    EXPECT_NEAR(mean.y, 0.5, 0.015) << spp;
    EXPECT_NEAR(mean.z, 0.25, 0.015) << spp;
  }
}

TEST(SampleGrid, RefusesCountsOutOfRange) {
  EXPECT_THROW((void)sample_grid(0, 1), Error);
  EXPECT_THROW((void)sample_grid(4097, 1), Error);
}

TEST(Tiles, CoverEveryPixelOnce) {
  const auto tiles = tiles_of({70, 33}, 32);
  std::set<std::pair<int, int>> pixels;
  for (const Tile& tile : tiles) {
    for (int y = 0; y < tile.size.y; ++y) {
      for (int x = 0; x < tile.size.x; ++x) EXPECT_TRUE(pixels.emplace(tile.origin.x + x, tile.origin.y + y).second);
    }
  }
  EXPECT_EQ(pixels.size(), 70U * 33U);
}

// A world point's window position is the same through a tile as through the whole picture.
TEST(TileMatrix, KeepsThePositionOfAPoint) {
  View view{.size = {70, 33}, .camera = {}};
  view.camera.world[3] = {0, 0, 3, 1};
  const glm::vec4 point(0.3F, -0.2F, 0.1F, 1.0F);
  const auto window = [&](const Tile& tile, const glm::dvec2& offset) {
    const glm::vec4 clip = tile_matrix(view, tile, offset) * point;
    return (glm::dvec2(clip) / static_cast<double>(clip.w) * 0.5 + 0.5) * glm::dvec2(tile.size) +
           glm::dvec2(tile.origin);
  };
  const glm::dvec2 whole = window({{0, 0}, {70, 33}}, {0, 0});
  EXPECT_NEAR(glm::distance(window({{32, 0}, {32, 32}}, {0, 0}), whole), 0.0, 1e-3);
  // Samples that lie to the right see the scene moved to the left.
  EXPECT_NEAR(window({{32, 0}, {32, 32}}, {0.25, 0}).x, whole.x - 0.25, 1e-3);
}

TEST(Quantile, InterpolatesOrderStatistics) {
  EXPECT_DOUBLE_EQ(quantile({3, 1, 2}, 0.5), 2);
  EXPECT_DOUBLE_EQ(quantile({1, 2}, 0.5), 1.5);
  EXPECT_DOUBLE_EQ(quantile({5}, 0.9), 5);
  EXPECT_DOUBLE_EQ(quantile({0, 10}, 0.9), 9);
}

// The ranks are those of a table of the binomial distribution: n = 6, 9, 15, 25 (Conover, Practical Nonparametric
// Statistics, table A3).
TEST(MedianInterval, IsBetweenTheRanksOfTheBinomialTable) {
  const std::array<std::array<int, 3>, 4> ranks = {{{6, 1, 6}, {9, 2, 8}, {15, 4, 12}, {25, 8, 18}}};
  for (const auto& [count, low, high] : ranks) {
    std::vector<double> values(static_cast<std::size_t>(count));
    std::iota(values.rbegin(), values.rend(), 1.0);
    const MedianInterval interval = median_interval(values);
    EXPECT_EQ(interval.low, low) << count;
    EXPECT_EQ(interval.high, high) << count;
  }
}

TEST(MedianInterval, OfTooFewValuesIsTheirExtremes) {
  EXPECT_EQ(median_interval({3, 1, 2}).low, 1);
  EXPECT_EQ(median_interval({3, 1, 2}).high, 3);
  EXPECT_EQ(median_interval({4}).low, 4);
}

TEST(PairedRatios, DivideRepeatByRepeat) {
  EXPECT_EQ(paired_ratios(std::vector{2.0, 9.0}, std::vector{1.0, 3.0}), (std::vector{2.0, 3.0}));
}

}  // namespace
}  // namespace footprint
