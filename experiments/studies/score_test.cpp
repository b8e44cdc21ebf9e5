// Which image is closer beyond noise, compared with references whose noise and true colours are known.
#include "experiments/studies/score.hpp"

#include <gtest/gtest.h>

#include <random>

namespace footprint {
namespace {

constexpr int edge = 200;
constexpr float channel_noise = 0.02F;  // standard error of each channel

Image even(float value) {
  Image image(edge, edge, 4);
  for (int y = 0; y < edge; ++y) {
    for (int x = 0; x < edge; ++x) std::ranges::copy(std::array{value, value, value, 1.0F}, image.at(x, y).begin());
  }
  return image;
}

// An even reference of this value with noise that is the same in all channels, or each channel's own.
Supersampled noisy(float value, bool same_in_all) {
  Supersampled reference{.spp = 64, .mean = even(value), .standard_error = Image(edge, edge, 3), .halves = {}};
  std::mt19937 random(7);
  std::normal_distribution<float> normal(0.0F, channel_noise);
  for (std::size_t i = 0; i < reference.mean.texel_count(); ++i) {
    const float common = normal(random);
    for (std::size_t c = 0; c < 3; ++c) {
      reference.mean.texels[4 * i + c] += same_in_all ? common : normal(random);
      reference.standard_error.texels[3 * i + c] = channel_noise;
    }
  }
  reference.halves.emplace(reference.mean, reference.mean);
  return reference;
}

CloserShares shares_of(const Image& a, const Image& b, const Supersampled& reference) {
  return closer_shares(*closer_beyond_noise(a, b, reference, 1.0F), Image(edge, edge, 1, 1.0F)).value();
}

TEST(Significance, NoiseAloneDecidesAlmostNothing) {
  // Both are equally far from the reference, so that any decision is wrong. 0.27% lie beyond three standard errors.
  const CloserShares together = shares_of(even(0.45F), even(0.55F), noisy(0.5F, true));
  EXPECT_LT(together.a + together.b, 0.004);
  EXPECT_GT(together.a + together.b, 0.0015);
  const CloserShares apart = shares_of(even(0.45F), even(0.55F), noisy(0.5F, false));
  EXPECT_LT(apart.a + apart.b, 1e-4);  // channels that err on their own cancel: the test errs on the safe side
}

TEST(Significance, WhatIsFarBeyondNoiseIsDecided) {
  // The middle of both is 6 standard errors off the reference: of three more than 99% are sure.
  const CloserShares shares = shares_of(even(0.45F), even(0.79F), noisy(0.5F, true));
  EXPECT_GT(shares.a, 0.99);
  EXPECT_EQ(shares.b, 0.0);
  const CloserShares turned = shares_of(even(0.79F), even(0.45F), noisy(0.5F, true));
  EXPECT_EQ(turned.a, 0.0);
  EXPECT_EQ(turned.b, shares.a);
}

TEST(Significance, EqualAndClippedPicturesDoNotDiffer) {
  const Supersampled reference = noisy(0.5F, true);
  const CloserShares equal = shares_of(even(0.4F), even(0.4F), reference);
  EXPECT_EQ(equal.a + equal.b, 0.0);
  const CloserShares clipped = shares_of(even(1.5F), even(4.0F), reference);
  EXPECT_EQ(clipped.a + clipped.b, 0.0);
}

TEST(Significance, RoundingIsNoDifference) {
  Supersampled exact = noisy(0.5F, true);
  exact.mean = even(0.5F);
  exact.standard_error = Image(edge, edge, 3);
  const CloserShares rounded = shares_of(even(0.5F), even(0.500005F), exact);
  EXPECT_EQ(rounded.a + rounded.b, 0.0);
  const CloserShares different = shares_of(even(0.5F), even(0.5001F), exact);
  EXPECT_EQ(different.a, 1.0);
}

TEST(Significance, OnlyWholePixelsAndThoseOfTheMaskCount) {
  Supersampled reference = noisy(0.5F, true);
  for (int x = 0; x < edge; ++x) reference.mean.at(x, 3)[3] = 0.5F;
  const Image verdicts = *closer_beyond_noise(even(0.45F), even(1.0F), reference, 1.0F);
  EXPECT_EQ(verdicts.at(10, 3)[0], 0.0F);
  EXPECT_EQ(verdicts.at(10, 4)[0], 1.0F);
  Image mask(edge, edge, 1);
  EXPECT_FALSE(closer_shares(verdicts, mask).has_value());
  mask.at(10, 4)[0] = mask.at(10, 3)[0] = 1.0F;
  EXPECT_EQ(closer_shares(verdicts, mask)->a, 0.5);
}

TEST(Significance, IsNotSaidWhereTheNoiseIsNotKnown) {
  Supersampled reference = noisy(0.5F, true);
  reference.halves.reset();
  EXPECT_FALSE(closer_beyond_noise(even(0.4F), even(0.9F), reference, 1.0F).has_value());
}

}  // namespace
}  // namespace footprint
