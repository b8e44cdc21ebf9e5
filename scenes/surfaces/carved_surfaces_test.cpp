// The noise and the formulas that the carved disk, the armor and the desert are made of, and their scenes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "renderer/scene/assembly/load_scene.hpp"
#include "scenes/surfaces/height.hpp"
#include "tests/support/source_folder.hpp"
#include "tests/support/surface_maps.hpp"

namespace footprint {
namespace {

using testing::make_map;

// Against differences of its own values, which know nothing of the formula for the gradient.
TEST(PeriodicNoise, HasTheGradientOfItsValues) {
  std::mt19937_64 random(5);
  const PeriodicNoise noise(7, random);
  const auto value = [&](double x, double y) { return noise.at(Height{x}, Height{y}).value(); };
  double largest = 0.0, sum = 0.0;
  for (int i = 0; i < 400; ++i) {
    const double x = -3.0 + 0.0523 * i, y = 11.0 - 0.0311 * i, step = 1e-5;
    const HeightPoint point{{x, y}};
    const Height at = noise.at(point.x, point.y);
    EXPECT_NEAR(slope_of(at).x, (value(x + step, y) - value(x - step, y)) / (2 * step), 1e-8);
    EXPECT_NEAR(slope_of(at).y, (value(x, y + step) - value(x, y - step)) / (2 * step), 1e-8);
    EXPECT_NEAR(at.value(), value(x + 7, y - 14), 1e-12);
    largest = std::max(largest, std::abs(at.value()));
    sum += at.value();
  }
  EXPECT_GT(largest, 0.3);
  EXPECT_LT(largest, 1.0);
  EXPECT_LT(std::abs(sum / 400), 0.1);
}

TEST(PeriodicNoise, IsZeroAtTheCornersOfItsCells) {
  std::mt19937_64 random(5);
  const PeriodicNoise noise(1, random);
  for (const double x : {-2.0, 0.0, 3.0}) EXPECT_EQ(noise.at(Height{x}, Height{1.0}).value(), 0.0);
}

TEST(Height, StepsBandsAndRidgesMeetTheirEnds) {
  EXPECT_EQ(smooth_step(Height{0.2}, 0.2, 0.6).value(), 0.0);
  EXPECT_NEAR(smooth_step(Height{0.4}, 0.2, 0.6).value(), 0.5, 1e-15);
  EXPECT_EQ(smooth_step(Height{0.6}, 0.2, 0.6).value(), 1.0);
  EXPECT_NEAR(smooth_band(Height{0.5}, 0.0, 1.0, 0.2).value(), 1.0, 1e-15);
  EXPECT_EQ(smooth_ridge(Height{-1.0}).value(), 0.0);
  EXPECT_EQ(smooth_ridge(Height{0.0}).value(), 1.0);
  EXPECT_EQ(higher(Height{1.0}, Height{2.0}).value(), 2.0);
}

/// The share of points where the slopes' curl is that of a height field, up to what differences leave: creases, where
/// the gradient jumps, are the rest.
double share_without_curl(const Image& map, double tolerance) {
  const auto slope = [&](int x, int y, std::size_t axis) {
    return -static_cast<double>(map.at(x, y)[axis]) / map.at(x, y)[2];
  };
  int good = 0, all = 0;
  for (int y = 1; y + 1 < map.height; y += 3) {
    for (int x = 1; x + 1 < map.width; x += 3) {
      const double by_x = slope(x + 1, y, 1) - slope(x - 1, y, 1), by_y = slope(x, y - 1, 0) - slope(x, y + 1, 0);
      good += std::abs(by_x - by_y) <= tolerance + 0.02 * (std::abs(by_x) + std::abs(by_y)) ? 1 : 0;
      ++all;
    }
  }
  return static_cast<double>(good) / all;
}

TEST(CarvedDisk, IsAHeightField) { EXPECT_GT(share_without_curl(make_map("carved_disk", 1536), 2e-3), 0.8); }

TEST(CarvedDisk, IsFlatBeyondTheRimAndWithoutDepth) {
  const Image map = make_map("carved_disk", 64);
  for (const auto& [x, y] : {std::pair{0, 0}, {63, 0}, {0, 63}, {63, 63}}) EXPECT_EQ(map.at(x, y)[2], 1.0F);
  for (const float z :
       {make_map("carved_disk", 33, {{"depth", "0"}}).at(16, 16)[2], make_map("carved_disk", 1).at(0, 0)[2]}) {
    EXPECT_EQ(z, 1.0F);
  }
}

// The ornament is cut by hand: without unevenness it is the same after a quarter turn (except where a texel is exactly
// on a crease), and with it, it is not.
TEST(CarvedDisk, RepeatsAroundTheMiddleButForTheHand) {
  const auto share_differing = [](const Image& map) {
    int differing = 0;
    for (int y = 0; y < map.height; ++y) {
      for (int x = 0; x < map.width; ++x) {
        const auto here = map.at(x, y), there = map.at(y, map.width - 1 - x);  // a quarter turn to the left
        differing += std::abs(here[0] - there[1]) + std::abs(here[1] + there[0]) > 1e-4F ? 1 : 0;
      }
    }
    return static_cast<double>(differing) / static_cast<double>(map.texel_count());
  };
  EXPECT_LT(share_differing(make_map("carved_disk", 201, {{"unevenness", "0"}})), 0.01);
  EXPECT_GT(share_differing(make_map("carved_disk", 201)), 0.5);
}

TEST(CarvedDisk, EngravingHasTwoSlopesOfOneTilt) {
  const Image map = make_map("carved_disk", 512, {{"depth", "0"}, {"engraving_degrees", "30"}});
  int inward = 0, outward = 0;
  for (int x = 257; x < 511; ++x) {  // the row of texels to the right of the middle
    EXPECT_NEAR(map.at(x, 256)[2], std::cos(glm::radians(30.0)), 1e-5);
    (map.at(x, 256)[0] > 0.0F ? outward : inward) += 1;
  }
  EXPECT_NEAR(inward, outward, 8);
  EXPECT_EQ(map.at(0, 0)[2], 1.0F);  // beyond the rim
}

TEST(GoldenArmor, ScalesAreRoundedAllOver) {
  const Image map = make_map("golden_armor", 512, {{"unevenness", "0"}});
  double lowest = 1.0, up = 0.0;
  int flat = 0;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      lowest = std::min(lowest, static_cast<double>(map.at(x, y)[2]));
      up += map.at(x, y)[1];
      flat += map.at(x, y)[2] > std::cos(glm::radians(2.0)) ? 1 : 0;
    }
  }
  EXPECT_LT(lowest, 0.5);
  EXPECT_LT(std::abs(up / static_cast<double>(map.texel_count())), 0.1);
  EXPECT_LT(flat, map.width * map.height / 100);
}

// The whole pattern moved by a part of the map that it repeats after is the pattern itself: so does the map's border.
TEST(GoldenArmor, Tiles) {
  const Image map = make_map("golden_armor", 256, {{"unevenness", "0"}, {"count", "4"}});
  double worst = 0.0;
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 256; ++x) {
      for (std::size_t c = 0; c < 3; ++c) {
        worst = std::max(worst,
                         std::abs(static_cast<double>(map.at(x, y)[c]) - map.at((x + 64) % 256, (y + 192) % 256)[c]));
      }
    }
  }
  EXPECT_LT(worst, 1e-5);
}

// Smooth ground: a step over the border is no larger than the steps on both sides of it.
TEST(Desert, Tiles) {
  const Image map = make_map("desert", 1024);
  const auto step = [&](int x0, int y0, int x1, int y1) {
    return std::hypot(map.at(x0, y0)[0] - map.at(x1, y1)[0], map.at(x0, y0)[1] - map.at(x1, y1)[1]);
  };
  double over = 0.0, beside = 0.0;
  for (int i = 0; i < 1024; ++i) {
    over += step(1023, i, 0, i) + step(i, 1023, i, 0);
    beside += 0.5 * (step(1022, i, 1023, i) + step(0, i, 1, i) + step(i, 1022, i, 1023) + step(i, 0, i, 1));
  }
  EXPECT_LT(over, 1.1 * beside);
}

TEST(Desert, SandIsOfOneColourNearly) {
  const Surface& desert = find_surface(all_surfaces(), "desert");
  SurfaceSettings settings = surface_settings(desert, {});
  settings.resolution = 256;
  const Image colors = surface_map(desert, settings, &Surface::base_color);
  ASSERT_EQ(colors.texel_count(), 256U * 256U);
  double darkest = 1.0, lightest = 0.0;
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 256; ++x) {
      const auto texel = colors.at(x, y);
      EXPECT_GT(texel[0], texel[1]);
      EXPECT_GT(texel[1], texel[2]);
      EXPECT_EQ(texel[3], 1.0F);
      darkest = std::min(darkest, static_cast<double>(texel[1]));
      lightest = std::max(lightest, static_cast<double>(texel[1]));
    }
  }
  EXPECT_GT(darkest, 0.25);
  EXPECT_LT(lightest, 0.45);
  EXPECT_GT(lightest - darkest, 0.05);
}

TEST(SurfaceScenes, LoadWithNothingLeftOpen) {
  const SceneLibrary library{.folder = testing::source_folder() / "scenes", .surfaces = all_surfaces()};
  const auto names = list_scenes(library.folder);
  for (const Surface& surface : all_surfaces()) {
    if (!std::ranges::binary_search(names, surface.name)) continue;  // part of a scene of another name
    const Scene scene = load_scene(surface.name, library);
    EXPECT_EQ(scene.name, surface.name);
    EXPECT_TRUE(scene.warnings.empty()) << surface.name;
    EXPECT_TRUE(scene.defaults.empty()) << surface.name;
    EXPECT_FALSE(scene.lights.empty());
    EXPECT_GT(scene.distances.size(), 3U);
    EXPECT_TRUE(scene.exposure && scene.frame_size) << surface.name;
    ASSERT_EQ(scene.materials.size(), 1U);
    ASSERT_TRUE(scene.materials[0].normal_map);
    EXPECT_EQ(scene.materials[0].base_color_map.has_value(), surface.base_color != nullptr);
  }
}

}  // namespace
}  // namespace footprint
