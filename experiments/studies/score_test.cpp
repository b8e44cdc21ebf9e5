// Which image is closer beyond noise, compared with references whose noise and true colours are known.
#include "experiments/studies/score.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "experiments/studies/measured_view.hpp"
#include "results/report/figure_table.hpp"
#include "tests/support/fresh_folder.hpp"
#include "tests/support/gltf_builder.hpp"

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

std::array<double, 2> shares_of(const Image& a, const Image& b, const Supersampled& reference) {
  return closer_shares(closer_beyond_noise(a, b, reference.mean, reference.standard_error, 1.0F),
                       Image(edge, edge, 1, 1.0F))
      .value();
}

TEST(Significance, NoiseAloneDecidesAlmostNothing) {
  // Both are equally far from the reference, so that any decision is wrong. 0.27% lie beyond three standard errors.
  const std::array<double, 2> together = shares_of(even(0.45F), even(0.55F), noisy(0.5F, true));
  EXPECT_LT(together[0] + together[1], 0.004);
  EXPECT_GT(together[0] + together[1], 0.0015);
  const std::array<double, 2> apart = shares_of(even(0.45F), even(0.55F), noisy(0.5F, false));
  EXPECT_LT(apart[0] + apart[1], 1e-4);  // channels that err on their own cancel: the test errs on the safe side
}

TEST(Significance, WhatIsFarBeyondNoiseIsDecided) {
  // The middle of both is 6 standard errors off the reference: of three more than 99% are sure.
  const std::array<double, 2> shares = shares_of(even(0.45F), even(0.79F), noisy(0.5F, true));
  EXPECT_GT(shares[0], 0.99);
  EXPECT_EQ(shares[1], 0.0);
  const std::array<double, 2> turned = shares_of(even(0.79F), even(0.45F), noisy(0.5F, true));
  EXPECT_EQ(turned[0], 0.0);
  EXPECT_EQ(turned[1], shares[0]);
}

TEST(Significance, EqualAndClippedPicturesDoNotDiffer) {
  const Supersampled reference = noisy(0.5F, true);
  const std::array<double, 2> equal = shares_of(even(0.4F), even(0.4F), reference);
  EXPECT_EQ(equal[0] + equal[1], 0.0);
  const std::array<double, 2> clipped = shares_of(even(1.5F), even(4.0F), reference);
  EXPECT_EQ(clipped[0] + clipped[1], 0.0);
}

TEST(Significance, RoundingIsNoDifference) {
  Supersampled exact = noisy(0.5F, true);
  exact.mean = even(0.5F);
  exact.standard_error = Image(edge, edge, 3);
  const std::array<double, 2> rounded = shares_of(even(0.5F), even(0.500005F), exact);
  EXPECT_EQ(rounded[0] + rounded[1], 0.0);
  const std::array<double, 2> different = shares_of(even(0.5F), even(0.5001F), exact);
  EXPECT_EQ(different[0], 1.0);
}

TEST(Significance, OnlyWholePixelsAndThoseOfTheMaskCount) {
  Supersampled reference = noisy(0.5F, true);
  for (int x = 0; x < edge; ++x) reference.mean.at(x, 3)[3] = 0.5F;
  const Image verdicts = closer_beyond_noise(even(0.45F), even(1.0F), reference.mean, reference.standard_error, 1.0F);
  EXPECT_EQ(verdicts.at(10, 3)[0], 0.0F);
  EXPECT_EQ(verdicts.at(10, 4)[0], 1.0F);
  Image mask(edge, edge, 1);
  EXPECT_FALSE(closer_shares(verdicts, mask).has_value());
  mask.at(10, 4)[0] = mask.at(10, 3)[0] = 1.0F;
  EXPECT_EQ(closer_shares(verdicts, mask)->at(0), 0.5);
}

TEST(Significance, IsNotSaidWhereTheNoiseIsNotKnown) {
  Reference target;
  target.reference = noisy(0.5F, true);
  target.parts.interior = Image(edge, edge, 1, 1.0F);
  const MeasuredView measured{.images = {even(0.4F), even(0.9F)}, .records = std::vector<Record>(2)};
  const auto unseen = [](std::size_t, std::size_t, const Image&) { return std::string(); };
  EXPECT_EQ(compare_pairs(measured, target, 1.0F, unseen).size(), 1U);
  target.reference.halves.reset();
  EXPECT_TRUE(compare_pairs(measured, target, 1.0F, unseen).empty());
}

// ---- the test per pixel ----

Image with_noise(float value, float deviation, unsigned seed) {
  Image image = even(value);
  std::mt19937 random(seed);
  std::normal_distribution<float> normal(0.0F, deviation);
  for (std::size_t i = 0; i < image.texels.size(); ++i) {
    if (i % 4 < 3) image.texels[i] += normal(random);
  }
  return image;
}

TEST(RejectedPixels, AreNoneOfNoiseAlone) {
  const PixelTest test{.reference_error = Image(edge, edge, 3, 0.02F), .picture_error = {}, .significance = 0.01};
  int images = 0;
  for (unsigned seed = 1; seed <= 40; ++seed)
    images += rejected_pixels(even(0.5F), with_noise(0.5F, 0.02F, seed), test) > 0 ? 1 : 0;
  EXPECT_LE(images, 3) << "of 40 images 0.4 are expected";
  const PixelTest both{.reference_error = Image(edge, edge, 3, 0.03F),
                       .picture_error = Image(edge, edge, 3, 0.04F),
                       .significance = 0.01};
  EXPECT_EQ(rejected_pixels(with_noise(0.5F, 0.04F, 5), with_noise(0.5F, 0.03F, 6), both), 0U);
}

TEST(RejectedPixels, AreThoseBeyondTheNoiseOfAllTests) {
  const PixelTest test{.reference_error = Image(edge, edge, 3, 0.02F), .picture_error = {}, .significance = 0.01};
  // Each of 120000 tests has a probability of 8.4e-8: 5.36 standard errors.
  Image picture = even(0.5F);
  picture.at(3, 4)[1] += 5.3F * 0.02F;
  EXPECT_EQ(rejected_pixels(picture, even(0.5F), test), 0U);
  picture.at(3, 4)[1] += 0.12F * 0.02F;
  EXPECT_EQ(rejected_pixels(picture, even(0.5F), test), 1U);
  Image uncovered = even(0.5F);
  uncovered.at(3, 4)[3] = 0.0F;
  EXPECT_EQ(rejected_pixels(picture, uncovered, test), 0U);
  const PixelTest exact{.reference_error = Image(edge, edge, 3), .picture_error = {}, .significance = 0.01};
  EXPECT_EQ(rejected_pixels(picture, even(0.5F), exact), 1U) << "without noise any difference counts";
}

// ---- limits ----

PictureScore score_of(std::vector<float> errors) {
  PictureScore score;
  score.name = "a.exr";
  score.pixel_errors = std::move(errors);
  score.error.normalized_color = 0.2;
  return score;
}

TEST(ScoreMetrics, AreTheFiguresOfAnyTwoImages) {
  PictureScore radiance = score_of({0.0F, 0.5F}), displayed = radiance;
  displayed.displayed = true;
  std::size_t count = 0;
  for (const Figure& figure : record_figures()) {
    if (!figure.metric) continue;
    const auto found = std::ranges::find(score_metrics(), metric_name(figure), &ScoreMetric::key);
    ASSERT_NE(found, score_metrics().end()) << figure.key;
    EXPECT_EQ(found->title, figure.title);
    EXPECT_EQ(found->value(radiance), metric_value(*figure.metric, radiance.error)) << figure.key;
    EXPECT_EQ(found->value(displayed), figure.is_of_radiance ? std::nullopt : found->value(radiance)) << figure.key;
    ++count;
  }
  EXPECT_EQ(score_metrics().size(), count + 3) << "a percentile, and FLIP twice";
}

TEST(ScoreLimits, AreAboutMeasuresPercentilesSharesAndTests) {
  PictureScore score = score_of({0.0F, 0.1F, 0.2F, 0.5F});
  const auto figure = [&](const std::string& text) { return figure_of(parse_score_limit(text), score); };
  EXPECT_EQ(figure("normalized_color=1"), 0.2);
  score.error.energy_bias = -0.5;
  EXPECT_EQ(figure("energy_bias=0.1"), 0.5) << "a loss of energy counts too";
  EXPECT_EQ(figure("p50=1"), 0.1F);
  EXPECT_EQ(figure("p75.1=1"), 0.5F);
  EXPECT_EQ(figure("p0=1"), 0.0F);
  EXPECT_EQ(figure("p100=1"), 0.5F);
  EXPECT_EQ(figure("share_above:0.1=1"), 0.5);
  EXPECT_EQ(figure("share_above:1=1"), 0.0);
  EXPECT_EQ(figure("rejected=0"), std::nullopt);
  score.rejected = 2;
  EXPECT_EQ(figure("rejected=0"), 2.0);
}

TEST(ScoreLimits, FailAboveTheirValue) {
  const std::vector<ScoreLimit> limits{parse_score_limit("p100=0.5"), parse_score_limit("p100=0.49"),
                                       parse_score_limit("rejected=0"), parse_score_limit("hdr_flip=1")};
  const std::vector<CheckOutcome> outcomes = limit_outcomes(limits, score_of({0.0F, 0.5F}));
  ASSERT_EQ(outcomes.size(), 4U);
  EXPECT_EQ(outcomes[0].failure, "");
  EXPECT_EQ(outcomes[1].failure, "it is 0.5");
  EXPECT_EQ(outcomes[1].suite, "a.exr");
  EXPECT_NE(outcomes[2].failure.find("--significance"), std::string::npos);
  EXPECT_NE(outcomes[3].failure.find("no such figure"), std::string::npos);
}

TEST(ScoreLimits, RefuseWhatTheyAreNot) {
  for (const auto& [text, words] :
       std::vector<std::pair<std::string, std::string>>{{"p99", "NAME=VALUE"},
                                                        {"=1", "NAME=VALUE"},
                                                        {"ldr_flp=1", "ldr_flip"},
                                                        {"psnr=30", "larger psnr is better"},
                                                        {"p101=1", "0 to 100"},
                                                        {"share_above:2=1", "0 to 1"},
                                                        {"p99=nan", "not a number"},
                                                        {"p99=", "not a number"}}) {
    EXPECT_NE(test::usage_error([&given = text] { return parse_score_limit(given); }).find(words), std::string::npos)
        << text;
  }
}

}  // namespace
}  // namespace footprint
