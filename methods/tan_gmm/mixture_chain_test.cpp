// Samples of a texel, and the chain of mixtures over all levels: what is independent of threads, and what aligning
// gains.
#include "methods/tan_gmm/mixture_chain.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "renderer/core/error.hpp"
#include "tests/methods/mixture_twin.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::tan_gmm {
namespace {

using testing::constant_normals;
using testing::random_normals;

Image map_of(int width, int height, const std::function<glm::dvec2(int, int)>& normal) {
  Image map(width, height, 4, 1.0F);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const glm::dvec2 n = normal(x, y);
      const std::array<double, 3> full{n.x, n.y, std::sqrt(1.0 - glm::dot(n, n))};
      std::ranges::transform(full, map.at(x, y).begin(), [](double v) { return static_cast<float>(v); });
    }
  }
  return map;
}

// V-grooves of 12 texels, whose flanks are a little rough along them: two spots of the disc, drawn out.
Image grooves(int size) {
  return map_of(size, size,
                [](int x, int y) { return glm::dvec2(x % 12 < 6 ? 0.45 : -0.45, 0.15 * std::sin(0.7 * x + 1.3 * y)); });
}

MixtureChain chain_of(const Image& map, const FitSettings& settings, Moment moment = Moment::corrected) {
  return mixture_chain(NormalField(map), settings, moment, no_progress);
}

std::vector<glm::dvec4> texel_of(const MixtureChain& chain, std::size_t level, int x, int y) {
  std::vector<glm::dvec4> out;
  for (const auto& layer : chain) {
    const auto t = layer[level].at(x, y);
    out.emplace_back(t[0], t[1], t[2], t[3]);
  }
  return out;
}

TEST(TanSamples, EveryNormalCountsOnceAtEveryLevel) {
  const NormalField field(random_normals(37, 11, 0.8F, 1));
  for (const auto& [width, height] : std::array<std::pair<int, int>, 5>{{{37, 11}, {18, 5}, {9, 2}, {4, 1}, {1, 1}}}) {
    double weight = 0;
    double x = 0;
    for (int j = 0; j < height; ++j) {
      for (int i = 0; i < width; ++i) {
        Samples samples;
        field.gather(width, height, i, j, samples);
        EXPECT_NEAR(samples.total_weight(), 37.0 / width * 11.0 / height, 1e-4);
        EXPECT_NEAR(field.coverage(width, height, samples), 1.0, 1e-6);
        for (std::size_t k = 0; k < samples.size(); ++k) x += static_cast<double>(samples.weight[k]) * samples.x[k];
        weight += samples.total_weight();
      }
    }
    Samples all;
    field.gather(1, 1, 0, 0, all);
    double mean = 0;
    for (const float v : all.x) mean += v;
    EXPECT_NEAR(weight, 37.0 * 11.0, 1e-3);
    EXPECT_NEAR(x, mean, 1e-3);
  }
}

// Five texels under two: the middle one is shared (weights 2, 2, 1 and 1, 2, 2 over 5, as in the mip chain).
TEST(TanSamples, AnOddSizeSharesTheMiddleTexel) {
  const NormalField field(map_of(5, 1, [](int x, int) { return glm::dvec2(0.1 * x, 0.0); }));
  Samples samples;
  field.gather(2, 1, 0, 0, samples);
  EXPECT_EQ(samples.weight, (std::vector<float>{1.0F, 1.0F, 0.5F}));
  field.gather(2, 1, 1, 0, samples);
  EXPECT_EQ(samples.weight, (std::vector<float>{0.5F, 1.0F, 1.0F}));
  EXPECT_NEAR(samples.x[0], 0.2F, 1e-7F);
}

TEST(TanSamples, InvalidNormalsHaveNoWeight) {
  Image map = constant_normals(4, 4, glm::vec3(0.6F, 0.0F, 0.8F));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::array<std::array<float, 4>, 3> bad{{{0, 0, 0, 1}, {1, 0, 0, 0}, {nan, 0, 1, 1}}};
  for (int i = 0; i < 3; ++i) std::ranges::copy(bad[static_cast<std::size_t>(i)], map.at(i, i).begin());
  const NormalField field(map);
  Samples samples;
  field.gather(1, 1, 0, 0, samples);
  EXPECT_EQ(samples.size(), 13U);
  EXPECT_NEAR(field.coverage(1, 1, samples), 13.0 / 16.0, 1e-6);
  for (const float x : samples.x) EXPECT_NEAR(x, 0.6F, 1e-6F);
}

// Below the surface: the nearest normal that is not.
TEST(TanSamples, NormalsBelowTheSurfaceGoToTheRim) {
  const NormalField field(constant_normals(1, 1, glm::vec3(0.6F, 0.0F, -0.8F)));
  Samples samples;
  field.gather(1, 1, 0, 0, samples);
  EXPECT_NEAR(samples.x.at(0), 1.0F, 1e-6F);
}

TEST(TanSamples, RepeatsBecomeOne) {
  Samples samples;
  for (const float x : {0.1F, 0.1F, 0.2F, 0.1F, 0.1F, 0.1F}) samples.add(x, 0.3F, 0.0F, 2.0F);
  samples.add(0.1F, 0.3F, 0.01F, 1.0F);  // another spread
  merge_repeats(samples);
  EXPECT_EQ(samples.x, (std::vector<float>{0.1F, 0.2F, 0.1F, 0.1F}));
  EXPECT_EQ(samples.weight, (std::vector<float>{4.0F, 2.0F, 6.0F, 1.0F}));
  Samples none;
  merge_repeats(none);
  EXPECT_EQ(none.size(), 0U);
}

// Tiles of a map whose levels they fit, and of one whose levels they do not: weight and moments of the normals.
TEST(TanSamples, TilesHoldWhatTheirTexelsDo) {
  for (const auto& [width, height] : std::array<std::pair<int, int>, 3>{{{64, 32}, {48, 80}, {37, 50}}}) {
    const NormalField field(random_normals(width, height, 0.9F, 9));
    const PooledTiles tiles(field);
    for (const auto& [columns, rows] : std::array<std::pair<int, int>, 3>{{{1, 1}, {2, 1}, {3, 5}}}) {
      Samples own;
      Samples pooled;
      field.gather(columns, rows, columns - 1, rows - 1, own);
      tiles.gather(columns, rows, columns - 1, rows - 1, pooled);
      EXPECT_LE(pooled.size(), own.size());
      const auto moment = [](const Samples& s, bool second) {
        double sum = 0;
        for (std::size_t i = 0; i < s.size(); ++i)
          sum += s.weight[i] * (second ? s.x[i] * s.x[i] + s.y[i] * s.y[i] + s.spread[i] : s.x[i]);
        return sum;
      };
      EXPECT_NEAR(pooled.total_weight(), own.total_weight(), 1e-3);
      for (const bool second : {false, true})
        EXPECT_NEAR(moment(pooled, second), moment(own, second), 1e-5 * own.total_weight());
    }
  }
}

TEST(TanSamples, PoolingKeepsTheMoments) {
  const NormalField field(random_normals(128, 64, 0.9F, 2));
  Samples samples;
  field.gather(1, 1, 0, 0, samples);
  const auto moments = [](const Samples& s) {
    std::array<double, 4> sum{};
    for (std::size_t i = 0; i < s.size(); ++i) {
      const double w = s.weight[i];
      const double square = static_cast<double>(s.x[i]) * s.x[i] + static_cast<double>(s.y[i]) * s.y[i];
      for (std::size_t k = 0; k < 4; ++k)
        sum[k] += w * std::array<double, 4>{1, s.x[i], s.y[i], square + s.spread[i]}[k];
    }
    return sum;
  };
  const std::array<double, 4> before = moments(samples);
  CellPool().pool(samples);
  EXPECT_LT(samples.size(), 8192U);
  const std::array<double, 4> after = moments(samples);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(after[k], before[k], 1e-6 * before[0]);
}

// The relative L2 distance of two NDFs over the disc.
double ndf_distance(std::span<const Recovered> mixture, const std::function<double(const glm::dvec3&)>& expected,
                    double base) {
  double difference = 0;
  double norm = 0;
  constexpr int cells = 80;
  for (int j = 0; j < cells; ++j) {
    for (int i = 0; i < cells; ++i) {
      const glm::dvec2 p((i + 0.5) * 2.0 / cells - 1.0, (j + 0.5) * 2.0 / cells - 1.0);
      if (glm::dot(p, p) >= 0.99) continue;
      const glm::dvec3 h(p, std::sqrt(1.0 - glm::dot(p, p)));
      const double d = expected(h);
      const double error = ndf_cut_at_rim(mixture, base, h) - d;
      difference += error * error / h.z;
      norm += d * d / h.z;
    }
  }
  return std::sqrt(difference / norm);
}

// Gaussians of the base lobe's width over the disc about every sample.
double sum_over(const Samples& samples, double base, const glm::dvec3& h) {
  double sum = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Recovered facet{samples.weight[i], samples.x[i], samples.y[i], 0.0};
    sum += ndf_cut_at_rim({&facet, 1}, base, h);
  }
  return sum / samples.total_weight();
}

// Cells of 1/128 under lobes several times as wide: pooling may cost next to nothing.
TEST(TanSamples, PoolingLeavesTheFit) {
  const NormalField field(random_normals(64, 64, 0.5F, 3));
  Samples samples;
  field.gather(1, 1, 0, 0, samples);
  Samples pooled = samples;
  CellPool().pool(pooled);
  const auto fitted = [](const Samples& s) {
    std::array<Gaussian, 4> mixture{};
    fit_texel(s, Prior(1.0), {}, {}, mixture);
    std::vector<Recovered> out(mixture.size());
    std::ranges::transform(mixture, out.begin(), [](const Gaussian& g) {
      return Recovered{g.alpha, g.x, g.y, g.variance};
    });
    return out;
  };
  const std::vector<Recovered> exact = fitted(samples);
  const auto expected = [&](const glm::dvec3& h) { return ndf_cut_at_rim(exact, 1.0 / 512, h); };
  EXPECT_LT(ndf_distance(fitted(pooled), expected, 1.0 / 512), 2e-3);
}

TEST(TanChain, DoesNotDependOnThreads) {
  const Image map = random_normals(65, 47, 0.7F, 4);
  for (const bool align : {true, false}) {
    std::vector<MixtureChain> chains;
    for (const std::size_t threads : {1U, 2U, 4U}) {
      const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
      chains.push_back(chain_of(map, {.align = align}));
    }
    EXPECT_TRUE(chains[0] == chains[1] && chains[0] == chains[2]) << "align " << align;
  }
}

TEST(TanChain, EveryCountOfGaussiansKeepsWeightAndMean) {
  const Image map = random_normals(24, 15, 0.6F, 5);
  const NormalField field(map);
  for (std::size_t n = 1; n <= most_components; ++n) {
    const MixtureChain chain = chain_of(map, {.components = n, .align = false});
    ASSERT_EQ(chain.size(), n);
    for (std::size_t level = 0; level < chain[0].size(); ++level) {
      const Image& first = chain[0][level];
      for (int y = 0; y < first.height; ++y) {
        for (int x = 0; x < first.width; ++x) {
          glm::dvec4 sum(0.0);
          for (const glm::dvec4& t : texel_of(chain, level, x, y)) sum += t;
          Samples samples;
          field.gather(first.width, first.height, x, y, samples);
          glm::dvec4 expected(0.0);
          for (std::size_t k = 0; k < samples.size(); ++k) {
            const double nx = samples.x[k];
            const double ny = samples.y[k];
            expected += static_cast<double>(samples.weight[k]) * glm::dvec4(1.0, nx, ny, nx * nx + ny * ny);
          }
          expected /= samples.total_weight();
          // A maximum of the likelihood keeps weight and mean of the samples, and their second moment.
          EXPECT_LT(glm::length(sum - expected), 1e-5) << "n " << n << ", level " << level;
        }
      }
    }
  }
}

TEST(TanChain, AConstantMapIsOneNormalAtEveryLevel) {
  const MixtureChain chain = chain_of(constant_normals(16, 9, glm::vec3(0.28F, 0.0F, 0.96F)), {});
  for (std::size_t level = 0; level < chain[0].size(); ++level) {
    for (int y = 0; y < chain[0][level].height; ++y) {
      for (int x = 0; x < chain[0][level].width; ++x) {
        double total = 0;
        for (const Recovered& r : recovered_mixture(texel_of(chain, level, x, y))) {
          total += r.share;
          if (r.share == 0.0) continue;
          EXPECT_NEAR(r.x, 0.28, 1e-6);
          EXPECT_LT(r.spread, 1e-6);
        }
        EXPECT_NEAR(total, 1.0, 1e-6);
      }
    }
  }
}

TEST(TanChain, SmallestMaps) {
  const MixtureChain single = chain_of(constant_normals(1, 1, glm::vec3(0.6F, 0.0F, 0.8F)), {});
  EXPECT_EQ(single[0].size(), 1U);
  EXPECT_EQ(chain_of(random_normals(1, 7, 0.5F, 6), {})[0].size(), 3U);
  Image invalid = constant_normals(2, 2, glm::vec3(0.6F, 0.0F, 0.8F));
  for (std::size_t i = 3; i < invalid.texels.size(); i += 4) invalid.texels[i] = 0.0F;
  for (const auto& layer : chain_of(invalid, {})) {
    for (const Image& level : layer) EXPECT_EQ(level.texels, std::vector<float>(level.texels.size(), 0.0F));
  }
}

// One invalid normal of 16: the result is the mean of the other 15.
TEST(TanChain, InvalidNormalsWeighNothing) {
  Image map = random_normals(4, 4, 0.5F, 7);
  std::ranges::fill(map.at(1, 2), 0.0F);
  glm::dvec2 mean(0.0);
  for (std::size_t i = 0; i < 16; ++i) mean += glm::dvec2(map.texels[4 * i], map.texels[4 * i + 1]) / 15.0;
  glm::dvec4 sum(0.0);
  for (const glm::dvec4& t : texel_of(chain_of(map, {.align = false}), 2, 0, 0)) sum += t;
  EXPECT_NEAR(sum.x, 15.0 / 16.0, 1e-6);
  EXPECT_NEAR(sum.y / sum.x, mean.x, 1e-5);
  EXPECT_NEAR(sum.z / sum.x, mean.y, 1e-5);
}

// The mean L2 distance from the exact NDF of texels sampled half-way to the next on the right, at one level.
double half_way_error(const Image& map, const FitSettings& settings, std::size_t level, Moment moment) {
  constexpr double base = 1.0 / 64;
  const NormalField field(map);
  const MixtureChain chain = chain_of(map, settings, moment);
  const int width = chain[0][level].width;
  const int height = chain[0][level].height;
  double sum = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x + 1 < width; ++x) {
      std::vector<glm::dvec4> blended = texel_of(chain, level, x, y);
      const std::vector<glm::dvec4> right = texel_of(chain, level, x + 1, y);
      for (std::size_t i = 0; i < blended.size(); ++i) blended[i] = 0.5 * (blended[i] + right[i]);
      Samples both;
      Samples other;
      field.gather(width, height, x, y, both);
      field.gather(width, height, x + 1, y, other);
      for (std::size_t k = 0; k < other.size(); ++k) both.add(other.x[k], other.y[k], 0.0F, other.weight[k]);
      const auto expected = [&](const glm::dvec3& h) { return sum_over(both, base, h); };
      sum += ndf_distance(recovered_mixture(blended, moment == Moment::corrected), expected, base);
    }
  }
  return sum / (height * (width - 1));
}

// Why the paper aligns (Figure 5): blended without, the two flanks of a groove become one wide lobe.
TEST(TanChain, AligningGainsBetweenTexels) {
  const Image map = grooves(32);
  for (const std::size_t level : {1U, 2U, 3U}) {
    const double on = half_way_error(map, {}, level, Moment::corrected);
    const double off = half_way_error(map, {.align = false}, level, Moment::corrected);
    EXPECT_LT(on, 0.2 * off) << "level " << level;
    const double clusters_on = half_way_error(map, {.start = Start::clusters}, level, Moment::corrected);
    const double clusters_off =
        half_way_error(map, {.align = false, .start = Start::clusters}, level, Moment::corrected);
    EXPECT_LT(clusters_on, clusters_off) << "level " << level;
  }
}

TEST(TanChain, TheCorrectedMomentGainsBetweenTexels) {
  const Image map = grooves(32);
  EXPECT_LT(half_way_error(map, {}, 2, Moment::corrected), half_way_error(map, {}, 2, Moment::published));
}

TEST(TanChain, ReportsProgressAndStops) {
  const Image map = random_normals(32, 32, 0.5F, 8);
  double last = 0;
  (void)mixture_chain(NormalField(map), {}, Moment::corrected, [&](std::string_view, double fraction) {
    EXPECT_GE(fraction, last);
    last = fraction;
  });
  EXPECT_NEAR(last, 1.0, 1e-12);
  for (const bool align : {true, false}) {
    int calls = 0;
    const auto stop = [&](std::string_view, double) {
      if (++calls == 40) throw Error(ErrorKind::interrupted, "", "stopped");
    };
    EXPECT_THROW((void)mixture_chain(NormalField(map), {.align = align}, Moment::corrected, stop), Error);
    EXPECT_EQ(calls, 40);
  }
}

}  // namespace
}  // namespace footprint::tan_gmm
