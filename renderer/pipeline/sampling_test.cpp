// Sample grids, tiles and timing statistics: the arithmetic around a picture.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "renderer/core/error.hpp"
#include "renderer/pipeline/sample_grid.hpp"
#include "renderer/pipeline/timing.hpp"
#include "renderer/pipeline/view.hpp"

namespace footprint {
namespace {

std::vector<glm::dvec2> all_samples(const SampleGrid& grid) {
  std::vector<glm::dvec2> samples;
  for (const glm::dvec2& offset : grid.offsets) {
    for (int y = 0; y < grid.grid; ++y) {
      for (int x = 0; x < grid.grid; ++x)
        samples.push_back((glm::dvec2(x, y) + 0.5 + offset) / static_cast<double>(grid.grid));
    }
  }
  return samples;
}

TEST(SampleGrid, HasTheCountAskedForInsideThePixel) {
  for (const int spp : {1, 2, 3, 7, 16, 36, 64, 100, 127, 4096}) {
    const auto samples = all_samples(sample_grid(spp, 1));
    ASSERT_EQ(samples.size(), static_cast<std::size_t>(spp));
    for (const glm::dvec2& s : samples) EXPECT_TRUE(s.x >= 0 && s.x < 1 && s.y >= 0 && s.y < 1);
  }
}

TEST(SampleGrid, SquaresAreStratified) {
  for (const int edge : {2, 4, 6, 8}) {
    std::set<std::pair<int, int>> cells;
    for (const glm::dvec2& s : all_samples(sample_grid(edge * edge, 9)))
      cells.emplace(static_cast<int>(s.x * edge), static_cast<int>(s.y * edge));
    EXPECT_EQ(cells.size(), static_cast<std::size_t>(edge * edge));
  }
}

TEST(SampleGrid, FollowsTheSeed) {
  EXPECT_EQ(sample_grid(64, 5).offsets, sample_grid(64, 5).offsets);
  EXPECT_NE(sample_grid(64, 5).offsets, sample_grid(64, 6).offsets);
}

TEST(SampleGrid, IsUnbiasedWhereStrataStayEmpty) {
  glm::dvec2 mean(0);
  constexpr int seeds = 2000;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    for (const glm::dvec2& s : all_samples(sample_grid(7, seed))) mean += s / (7.0 * seeds);
  }
  EXPECT_NEAR(mean.x, 0.5, 0.01);
  EXPECT_NEAR(mean.y, 0.5, 0.01);
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

TEST(PairedRatios, DivideRepeatByRepeat) {
  EXPECT_EQ(paired_ratios(std::vector{2.0, 9.0}, std::vector{1.0, 3.0}), (std::vector{2.0, 3.0}));
}

}  // namespace
}  // namespace footprint
