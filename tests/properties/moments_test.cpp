// Moments of slope, and mip chains: what filtering may never change.
#include "renderer/bake/slope_moments.hpp"
#include "renderer/image/mipmap.hpp"
#include "tests/properties/inputs.hpp"

namespace footprint::testing {
namespace {

SlopeMoments any_moments() {
  const glm::dvec2 mean(number(-50, 50), number(-50, 50));
  const double a = magnitude(1e-12, 2500), b = magnitude(1e-12, 2500), share = number(-1, 1);
  const double across = share * std::sqrt(a * b);
  SlopeMoments out{mean, glm::outerProduct(mean, mean) + glm::dmat2(a, across, across, b)};
  return out;
}

double least_eigenvalue(const glm::dmat2& m) {
  const double half = 0.5 * (m[0][0] + m[1][1]);
  return half - std::hypot(0.5 * (m[0][0] - m[1][1]), m[0][1]);
}

RC_GTEST_PROP(Slopes, AreNoSteeperThanTheSteepest, ()) {
  const glm::dvec3 n = direction();
  const double steepest = magnitude(0.1, 50);
  const glm::dvec2 slope = slope_of(n, steepest);
  RC_ASSERT(glm::length(slope) <= steepest * (1.0 + 1e-12));
  RC_ASSERT(glm::dot(slope, glm::dvec2(n)) <= 0.0);
}

RC_GTEST_PROP(Slopes, HaveACovarianceWithoutNegativeEigenvalues, ()) {
  SlopeMoments moments = any_moments();
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) moments.second[i][j] = static_cast<float>(moments.second[i][j]);  // as maps keep them
  }
  const glm::dmat2 m = covariance(moments);
  RC_ASSERT(m[0][1] == m[1][0]);
  RC_ASSERT(least_eigenvalue(m) >= -1e-9 * (m[0][0] + m[1][1]));
}

RC_GTEST_PROP(Slopes, OfLayersAdd, ()) {
  const SlopeMoments a = any_moments(), b = any_moments(), both = layered(a, b);
  const glm::dmat2 sum = covariance(a) + covariance(b), found = covariance(both);
  RC_ASSERT(glm::length(both.mean - (a.mean + b.mean)) <= 1e-9);
  const double scale = both.second[0][0] + both.second[1][1];
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) RC_ASSERT(std::abs(found[i][j] - sum[i][j]) <= 1e-9 * (1.0 + scale));
  }
}

double mean_of(const Image& image, int channel) {
  double sum = 0.0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) sum += image.at(x, y)[static_cast<std::size_t>(channel)];
  }
  return sum / static_cast<double>(image.texel_count());
}

RC_GTEST_PROP(Chains, KeepTheMeanAtAnySize, ()) {
  const Image map = normal_map();
  const std::vector<Image> chain = mip_chain(map);
  RC_ASSERT(static_cast<int>(chain.size()) == mip_level_count(map.width, map.height));
  for (const Image& level : chain) {
    for (int c = 0; c < 4; ++c) RC_ASSERT(std::abs(mean_of(level, c) - mean_of(map, c)) <= 1e-6);
  }
}

RC_GTEST_PROP(Chains, OfTexelsWithoutANormalKeepTheMeanOfTheOthers, ()) {
  const Image map = normal_map(0.3);
  double weight = 0.0;
  glm::dvec3 sum(0.0);
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const auto texel = map.at(x, y);
      weight += texel[3];
      sum += static_cast<double>(texel[3]) * glm::dvec3(texel[0], texel[1], texel[2]);
    }
  }
  RC_PRE(weight > 0.0);
  const Image last = weighted_mip_chain(map).back();
  for (int c = 0; c < 3; ++c) RC_ASSERT(std::abs(last.texels[static_cast<std::size_t>(c)] - sum[c] / weight) <= 1e-5);
  RC_ASSERT(std::abs(last.texels[3] - weight / static_cast<double>(map.texel_count())) <= 1e-6);
}

RC_GTEST_PROP(Chains, OfSlopesHaveNoLessThanTheSquareOfTheMean, ()) {
  const std::vector<Image> chain = slope_moment_chain(normal_map(0.1), Image(1, 1, 1, 0.0F), 6.0);
  for (const Image& level : chain) {
    for (int y = 0; y < level.height; ++y) {
      for (int x = 0; x < level.width; ++x) {
        const auto t = level.at(x, y);
        const double rounding = 1e-5 * (1.0 + t[slope_xx] + t[slope_yy]);
        RC_ASSERT(t[slope_xx] + rounding >= static_cast<double>(t[slope_x]) * t[slope_x]);
        RC_ASSERT(t[slope_yy] + rounding >= static_cast<double>(t[slope_y]) * t[slope_y]);
      }
    }
  }
}

}  // namespace
}  // namespace footprint::testing
