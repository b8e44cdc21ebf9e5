// Moments of slope against sums over texels and pairs of texels, and golden numbers.
#include "renderer/bake/slope_moments.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "renderer/bake/prefiltered.hpp"
#include "renderer/core/error.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing {
namespace {

const Image no_variance(1, 1, 1, 0.0F);

SlopeMoments moments_at(const Image& level, int x = 0, int y = 0) {
  const auto t = level.at(x, y);
  return {{t[slope_x], t[slope_y]}, {t[slope_xx], t[slope_xy], t[slope_xy], t[slope_yy]}};
}

// Golden: B, Sigma + 1/s and its determinant for exponent 100, the roughness in the moments or added to the covariance.
// Half the texels have lobes brushed along x, half along y, of different widths.
TEST(SlopeMoments, IncludeTheCovarianceOfStretchedLobes) {
  Image variance(2, 1, 1), stretch(2, 1, 2);
  variance.texels = {0.02F, 0.05F};
  stretch.texels = {0.5F, 0.25F, -0.75F, 0.5F};
  const SlopeMoments m = moments_at(
      slope_moment_chain(constant_normals(2, 1, {0.0F, 0.0F, 1.0F}), variance, steepest_slope, stretch).back());
  EXPECT_NEAR(m.second[0][0], 0.5 * (0.02 * 1.5 + 0.05 * 0.25), 1e-8);
  EXPECT_NEAR(m.second[1][1], 0.5 * (0.02 * 0.5 + 0.05 * 1.75), 1e-8);
  EXPECT_NEAR(m.second[0][1], 0.5 * (0.02 * 0.25 + 0.05 * 0.5), 1e-8);
}

TEST(SlopeMoments, FourTexelsMeetTheGoldenVector) {
  for (const bool in_moments : {false, true}) {
    const Image variance(1, 1, 1, in_moments ? 0.01F : 0.0F);
    const SlopeMoments m = moments_at(slope_moment_chain(four_texel_normals(), variance).back());
    const glm::dmat2 sigma = covariance(m) + glm::dmat2(in_moments ? 0.0 : 0.01);
    EXPECT_NEAR(m.mean.x, -0.1145833333333333, 1e-7);
    EXPECT_NEAR(m.mean.y, 0.18749999999999997, 1e-7);
    EXPECT_NEAR(sigma[0][0], 0.15876302083333332, 1e-7);
    EXPECT_NEAR(sigma[0][1], 0.02148437499999999, 1e-7);
    EXPECT_NEAR(sigma[1][1], 0.11546874999999997, 1e-7);
    EXPECT_NEAR(glm::determinant(sigma), 0.017870589192708335, 1e-7);
  }
}

// Hard case 27: sizes that are no power of two keep the mean of every channel to the top.
TEST(SlopeMoments, TopOfTheChainIsTheMeanOverAllTexels) {
  for (const auto& [width, height] : {std::pair{45, 7}, std::pair{64, 64}, std::pair{1, 19}}) {
    const Image normals = random_normals(width, height, 0.8F, 1);
    std::array<double, 5> sum{};
    for (std::size_t i = 0; i < normals.texels.size(); i += 4) {
      const double x = -normals.texels[i] / static_cast<double>(normals.texels[i + 2]);
      const double y = -normals.texels[i + 1] / static_cast<double>(normals.texels[i + 2]);
      const std::array<double, 5> texel{x, y, x * x, x * y, y * y};
      for (std::size_t c = 0; c < 5; ++c) sum[c] += texel[c] / static_cast<double>(normals.texel_count());
    }
    const Image top = slope_moment_chain(normals, no_variance).back();
    for (std::size_t c = 0; c < 5; ++c) EXPECT_NEAR(top.texels[c], sum[c], 1e-6) << width << " channel " << c;
  }
}

// Hard case 25: a normal of no length leaves the mean of the others, and so does one that is not finite.
TEST(SlopeMoments, InvalidNormalsDoNotCount) {
  for (const float broken : {0.0F, std::numeric_limits<float>::quiet_NaN()}) {
    Image normals = random_normals(4, 4, 0.6F, 2);
    Image others(15, 1, 4);
    std::copy_n(&normals.texels[4], 60, others.texels.begin());
    for (std::size_t c = 0; c < 3; ++c) normals.texels[c] = broken;
    normals.texels[3] = 0.0F;
    const Image top = slope_moment_chain(normals, no_variance).back();
    const Image expected = slope_moment_chain(others, no_variance).back();
    for (std::size_t c = 0; c < 5; ++c) EXPECT_NEAR(top.texels[c], expected.texels[c], 1e-5);
  }
}

// Hard case 28: the horizon and directions below it have the steepest slope.
TEST(SlopeMoments, HorizontalNormalsHaveAFiniteSlope) {
  EXPECT_EQ(slope_of({1, 0, 0}), glm::dvec2(-steepest_slope, 0));
  EXPECT_LE(glm::length(slope_of(glm::normalize(glm::dvec3(1, 1, -3)))), steepest_slope);
  const Image top = slope_moment_chain(constant_normals(3, 3, {1, 0, 0}), no_variance).back();
  EXPECT_FLOAT_EQ(top.texels[slope_xx], 2500.0F);
}

// Two layers, every texel of one over every texel of the other: slopes add.
TEST(SlopeMoments, LayersMeetTheSumOverPairs) {
  const Image a = random_normals(5, 3, 0.7F, 3);
  const Image b = random_normals(4, 6, 0.5F, 4);
  glm::dvec2 mean(0);
  glm::dmat2 second(0);
  for (std::size_t i = 0; i < a.texels.size(); i += 4) {
    for (std::size_t j = 0; j < b.texels.size(); j += 4) {
      const glm::dvec2 slope = slope_of({a.texels[i], a.texels[i + 1], a.texels[i + 2]}) +
                               slope_of({b.texels[j], b.texels[j + 1], b.texels[j + 2]});
      mean += slope;
      second += glm::outerProduct(slope, slope);
    }
  }
  const auto pairs = static_cast<double>(a.texel_count() * b.texel_count());
  const SlopeMoments both = layered(moments_at(slope_moment_chain(a, no_variance).back()),
                                    moments_at(slope_moment_chain(b, no_variance).back()));
  EXPECT_LT(glm::length(both.mean - mean / pairs), 1e-6);
  for (int c = 0; c < 2; ++c) EXPECT_LT(glm::length(both.second[c] - second[c] / pairs), 1e-6);
}

// Independent layers: not the second moments but the covariances add.
TEST(SlopeMoments, CovariancesOfLayersAdd) {
  const SlopeMoments a{{0.3, -0.2}, {0.29, -0.05, -0.05, 0.14}};
  const SlopeMoments b{{-0.5, 0.4}, {0.35, -0.15, -0.15, 0.36}};
  const glm::dmat2 sum = covariance(a) + covariance(b);
  const glm::dmat2 both = covariance(layered(a, b));
  for (int c = 0; c < 2; ++c) EXPECT_LT(glm::length(both[c] - sum[c]), 1e-14);
}

TEST(SlopeMoments, RoughnessOfAnotherSizeIsAnError) {
  EXPECT_THROW((void)slope_moment_chain(random_normals(4, 4, 0.1F, 1), Image(2, 2, 1, 0.1F)), Error);
}

struct Cancellation {
  Storage storage;
  double mean, deviation, median, p99;
};

// Golden `lean_cancellation`: 8 x 8 texels of slopes with a standard deviation per axis and a mean of a given length
// (here along the diagonal), three roundings to storage. Here sums are taken in double and half floats are rounded to
// once: no error may be above the golden one by more than the sampling of 400 maps explains.
TEST(SlopeMoments, CancellationStaysWithinTheGoldenErrors) {
  std::mt19937 random(5);
  for (const Cancellation& g : {Cancellation{Storage::fp16, 0.5, 0.05, 0.01458, 0.06253},
                                {Storage::fp16, 1.0, 0.1, 0.014946, 0.060374},
                                {Storage::fp16, 3.0, 0.2, 0.03884, 0.14552},
                                {Storage::fp32, 0.5, 1e-3, 0.0042483, 0.0152623},
                                {Storage::fp32, 1.0, 3e-3, 0.0018253, 0.0071014},
                                {Storage::fp32, 3.0, 1e-4, 19.674, 73.591}}) {
    std::normal_distribution<double> slope(g.mean / std::sqrt(2.0), g.deviation);
    std::vector<double> errors;
    for (int run = 0; run < 400; ++run) {
      Image normals(8, 8, 4, 1.0F);
      SlopeMoments exact;
      for (std::size_t i = 0; i < normals.texels.size(); i += 4) {
        const glm::vec3 n = glm::normalize(glm::dvec3(-slope(random), -slope(random), 1.0));
        std::copy_n(&n.x, 3, &normals.texels[i]);
        const glm::dvec2 b = slope_of(n);
        exact.mean += b / 64.0;
        exact.second += glm::outerProduct(b, b) / 64.0;
      }
      const std::vector<Image> chain = slope_moment_chain(normals, no_variance);
      const PrefilteredTexture stored = make_texture("moments", {chain.back()}, g.storage, {});
      const glm::dmat2 recovered = covariance(moments_at(decode_level(stored, 0)));
      const glm::dmat2 expected = exact.second - glm::outerProduct(exact.mean, exact.mean);
      EXPECT_GE(glm::determinant(recovered), -1e-12);
      errors.push_back(std::abs((recovered[0][0] + recovered[1][1]) / (expected[0][0] + expected[1][1]) - 1.0));
    }
    std::ranges::sort(errors);
    EXPECT_LE(errors[200], 1.1 * g.median) << g.mean << ", " << g.deviation;
    EXPECT_LE(errors[396], 1.3 * g.p99) << g.mean << ", " << g.deviation;
  }
}

}  // namespace
}  // namespace footprint::testing
