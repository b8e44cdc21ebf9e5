// Mip chains: golden ramps, means that survive to the top, a brute-force area filter, texels without weight.
#include "renderer/image/mipmap.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <random>

#include <tbb/global_control.h>

#include "renderer/core/error.hpp"

namespace footprint {
namespace {

Image noise(int width, int height, int channels, unsigned seed = 1) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<float> uniform(0.0F, 1.0F);
  Image image(width, height, channels);
  std::ranges::generate(image.texels, [&] { return uniform(generator); });
  return image;
}

double mean_of(const Image& image, int channel) {
  double sum = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) sum += image.at(x, y)[channel];
  }
  return sum / static_cast<double>(image.texel_count());
}

// The part of [a0, a1) in [b0, b1).
double overlap(double a0, double a1, double b0, double b1) {
  return std::max(0.0, std::min(a1, b1) - std::max(a0, b0));
}

// The mean over the area of coarse texel (x, y), by the overlap of every fine texel with it.
double area_mean(const Image& fine, int coarse_width, int coarse_height, int x, int y, int channel) {
  const double step_x = static_cast<double>(fine.width) / coarse_width;
  const double step_y = static_cast<double>(fine.height) / coarse_height;
  double sum = 0;
  for (int j = 0; j < fine.height; ++j) {
    for (int i = 0; i < fine.width; ++i) {
      sum += fine.at(i, j)[channel] * overlap(i, i + 1, x * step_x, (x + 1) * step_x) *
             overlap(j, j + 1, y * step_y, (y + 1) * step_y);
    }
  }
  return sum / (step_x * step_y);
}

// Golden top texels of the ramp 0 .. n - 1: its mean; dropping the odd texel gives 1.5, 1.5, 3.5, 31.5, 127.5, 255.5.
TEST(Mipmap, RampsOfAnySizeKeepTheirMean) {
  const std::array<std::pair<int, double>, 6> golden{
      {{5, 2.0}, {7, 3.0}, {13, 6.0}, {100, 49.5}, {457, 228.0}, {671, 335.0}}};
  for (const auto& [size, mean] : golden) {
    Image ramp(size, 1, 1);
    for (int x = 0; x < size; ++x) ramp.at(x, 0)[0] = static_cast<float>(x);
    EXPECT_NEAR(mip_chain(ramp).back().at(0, 0)[0], mean, 1e-6 * mean) << size;
    Image column(1, size, 1);
    column.texels = ramp.texels;
    EXPECT_NEAR(mip_chain(column).back().at(0, 0)[0], mean, 1e-6 * mean) << size;
  }
}

class MipmapSizes : public testing::TestWithParam<std::pair<int, int>> {};

TEST_P(MipmapSizes, EveryLevelKeepsTheMeanOfEveryChannel) {
  const auto [width, height] = GetParam();
  const Image finest = noise(width, height, 4);
  const std::vector<Image> levels = mip_chain(finest);
  ASSERT_EQ(static_cast<int>(levels.size()), mip_level_count(width, height));
  EXPECT_EQ(levels.front(), finest);
  for (std::size_t l = 0; l < levels.size(); ++l) {
    EXPECT_EQ(levels[l].width, std::max(1, width >> l));
    EXPECT_EQ(levels[l].height, std::max(1, height >> l));
    for (int c = 0; c < 4; ++c) EXPECT_NEAR(mean_of(levels[l], c), mean_of(finest, c), 1e-6) << "level " << l;
  }
  EXPECT_EQ(levels.back().texel_count(), 1U);
}

TEST_P(MipmapSizes, EqualWeightsGiveThePlainChain) {
  const auto [width, height] = GetParam();
  Image finest = noise(width, height, 3);
  for (std::size_t i = 2; i < finest.texels.size(); i += 3) finest.texels[i] = 0.75F;
  const std::vector<Image> plain = mip_chain(finest);
  const std::vector<Image> weighted = weighted_mip_chain(finest);
  ASSERT_EQ(plain.size(), weighted.size());
  for (std::size_t l = 0; l < plain.size(); ++l) {
    for (std::size_t i = 0; i < plain[l].texels.size(); ++i) {
      ASSERT_NEAR(weighted[l].texels[i], plain[l].texels[i], 1e-6) << "level " << l;
    }
  }
}

// The weight of every level and the weighted mean of the others are those of the finest level.
TEST_P(MipmapSizes, WeightedSumsSurviveEveryLevel) {
  const auto [width, height] = GetParam();
  const Image finest = noise(width, height, 3);
  double weight = 0, first = 0;
  for (std::size_t i = 0; i < finest.texels.size(); i += 3) {
    weight += finest.texels[i + 2];
    first += static_cast<double>(finest.texels[i]) * finest.texels[i + 2];
  }
  const Image top = weighted_mip_chain(finest).back();
  EXPECT_NEAR(top.at(0, 0)[0], first / weight, 1e-6);
  EXPECT_NEAR(top.at(0, 0)[2], weight / static_cast<double>(finest.texel_count()), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Mipmap, MipmapSizes,
                         testing::Values(std::pair(1, 1), std::pair(1, 7), std::pair(5, 3), std::pair(457, 671),
                                         std::pair(64, 64), std::pair(256, 32), std::pair(1, 4096), std::pair(3, 1),
                                         std::pair(2, 2)),
                         [](const auto& tested) {
                           return std::to_string(tested.param.first) + "x" + std::to_string(tested.param.second);
                         });

TEST(Mipmap, LevelsAreTheExactAreaMean) {
  for (const auto& [width, height] : {std::pair(13, 9), std::pair(7, 8), std::pair(3, 1), std::pair(2, 5)}) {
    const Image fine = noise(width, height, 2, 7);
    const Image coarse = mip_chain(fine).at(1);
    for (int y = 0; y < coarse.height; ++y) {
      for (int x = 0; x < coarse.width; ++x) {
        for (int c = 0; c < 2; ++c) {
          EXPECT_NEAR(coarse.at(x, y)[c], area_mean(fine, coarse.width, coarse.height, x, y, c), 1e-7)
              << width << " x " << height << " at " << x << ", " << y;
        }
      }
    }
  }
}

TEST(Mipmap, LevelCountsFollowOpenGl) {
  EXPECT_EQ(mip_level_count(1, 1), 1);
  EXPECT_EQ(mip_level_count(2, 1), 2);
  EXPECT_EQ(mip_level_count(3, 3), 2);
  EXPECT_EQ(mip_level_count(457, 671), 10);
  EXPECT_EQ(mip_level_count(1, 4096), 13);
}

TEST(Mipmap, OneTexelIsTheWholeChain) {
  const Image one(1, 1, 3, 0.25F);
  EXPECT_EQ(mip_chain(one), std::vector{one});
  EXPECT_EQ(weighted_mip_chain(one), std::vector{one});
}

TEST(Mipmap, AConstantStaysExactlyConstant) {
  for (const Image& level : mip_chain(Image(37, 21, 1, 0.1F))) {
    for (const float texel : level.texels) EXPECT_FLOAT_EQ(texel, 0.1F);
  }
}

// A zero-length normal has weight 0: the mean is that of the other fifteen, for any invalid texel.
TEST(Mipmap, ATexelWithoutWeightLeavesTheMeanUntouched) {
  for (const float garbage : {0.0F, 1e30F, std::numeric_limits<float>::quiet_NaN()}) {
    Image image = noise(4, 4, 4, 3);
    for (std::size_t i = 3; i < image.texels.size(); i += 4) image.texels[i] = 1.0F;
    std::ranges::copy(std::array{garbage, garbage, garbage, 0.0F}, image.at(2, 1).begin());
    const Image top = weighted_mip_chain(image).back();
    for (int c = 0; c < 3; ++c) {
      double sum = 0;
      for (std::size_t i = 0; i < 16; ++i) sum += i == 6 ? 0.0 : image.texels[4 * i + c];
      EXPECT_NEAR(top.at(0, 0)[c], sum / 15, 1e-6);
    }
    EXPECT_NEAR(top.at(0, 0)[3], 15.0 / 16, 1e-7);
  }
}

TEST(Mipmap, WithoutAnyWeightThePlainMeanReplacesIt) {
  Image image(3, 1, 2);
  image.texels = {1, 0, 2, 0, 6, 0};
  const Image top = weighted_mip_chain(image).back();
  EXPECT_FLOAT_EQ(top.at(0, 0)[0], 3.0F);
  EXPECT_EQ(top.at(0, 0)[1], 0.0F);
}

TEST(Mipmap, TheResultDoesNotDependOnTheNumberOfThreads) {
  const Image finest = noise(601, 333, 4);
  const std::vector<Image> many = weighted_mip_chain(finest);
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(weighted_mip_chain(finest), many);
}

TEST(Mipmap, AnEmptyPictureIsRefused) { EXPECT_THROW((void)mip_chain(Image{}), Error); }

}  // namespace
}  // namespace footprint
