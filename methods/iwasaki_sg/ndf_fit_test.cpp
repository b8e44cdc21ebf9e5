// Fits of the normal distribution: known mixtures come back, flat facets stay exact, degenerate input is tolerated.
#include "methods/iwasaki_sg/lobe_fit.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "methods/iwasaki_sg/spherical_gaussian.hpp"
#include "renderer/core/numbers.hpp"
#include "renderer/lobes/lobe.hpp"

namespace footprint::iwasaki_sg {
namespace {

// Normals of a von Mises-Fisher lobe, by inversion of its cumulative distribution.
void draw(const SphericalGaussian& lobe, int count, double weight, std::mt19937_64& random,
          std::vector<WeightedNormal>& out) {
  const glm::dvec3 helper = std::abs(lobe.axis.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 s = glm::normalize(glm::cross(helper, lobe.axis));
  const glm::dvec3 t = glm::cross(lobe.axis, s);
  for (int i = 0; i < count; ++i) {
    const double u = -std::log1p(uniform(random) * std::expm1(-2.0 * lobe.sharpness)) / lobe.sharpness;
    const double turn = 2.0 * std::numbers::pi * uniform(random);
    const double sine = std::sqrt(std::max(u * (2.0 - u), 0.0));
    out.push_back({(1.0 - u) * lobe.axis + sine * (std::cos(turn) * s + std::sin(turn) * t), weight});
  }
}

TEST(NdfFit, FindsTheLobesThatNormalsWereDrawnFrom) {
  std::mt19937_64 random(3);
  const std::array<SphericalGaussian, 3> lobes{SphericalGaussian{{0, 0, 1}, 200.0},
                                               SphericalGaussian{glm::normalize(glm::dvec3(1, 0.2, 1)), 60.0},
                                               SphericalGaussian{glm::normalize(glm::dvec3(-0.5, -1, 1)), 1000.0}};
  std::vector<WeightedNormal> normals;
  for (const SphericalGaussian& lobe : lobes) draw(lobe, 600, 1.0, random, normals);
  const NdfFit fit = fit_ndf(normals, 3);
  ASSERT_EQ(fit.lobes.size(), 3U);
  for (const SphericalGaussian& lobe : lobes) {
    double nearest = 2.0;
    for (std::size_t j = 0; j < 3; ++j) {
      const double away = one_minus_dot(fit.lobes[j].axis, lobe.axis);
      if (away >= nearest) continue;
      nearest = away;
      if (away < 1e-3) {
        EXPECT_NEAR(fit.lobes[j].sharpness / lobe.sharpness, 1.0, 0.12);
        EXPECT_NEAR(fit.shares[j], 1.0 / 3.0, 0.01);
      }
    }
    EXPECT_LT(nearest, 1e-3);
  }
}

// Five flat facets: a lobe each, as sharp as lobes get, at the very normal.
TEST(NdfFit, FlatFacetsAreExact) {
  std::vector<WeightedNormal> normals{{{0, 0, 1}, 0.2}};
  for (const glm::dvec2& d : {glm::dvec2(1, 0), glm::dvec2(-1, 0), glm::dvec2(0, 1), glm::dvec2(0, -1)}) {
    normals.push_back({glm::normalize(glm::dvec3(d, 1.5)), 0.2});
  }
  const NdfFit fit = fit_ndf(normals, 8);
  ASSERT_EQ(fit.lobes.size(), 5U);
  for (std::size_t j = 0; j < 5; ++j) {
    double nearest = 2.0;
    for (const WeightedNormal& n : normals) nearest = std::min(nearest, one_minus_dot(n.normal, fit.lobes[j].axis));
    EXPECT_LT(nearest, 1e-12);
    EXPECT_NEAR(fit.lobes[j].sharpness / sharpest, 1.0, 1e-3);
    EXPECT_NEAR(fit.shares[j], 0.2, 1e-9);
  }
}

// Normals that hardly differ: no lobes that Eq. 8 cannot separate.
TEST(NdfFit, MergesLobesThatCoincide) {
  std::mt19937_64 random(9);
  std::vector<WeightedNormal> normals;
  draw({{0, 0, 1}, 50.0}, 500, 1.0, random, normals);
  const NdfFit fit = fit_ndf(normals, 8);
  for (std::size_t a = 0; a < fit.lobes.size(); ++a) {
    for (std::size_t b = a + 1; b < fit.lobes.size(); ++b) {
      const double c = correlation(fit.lobes[a], fit.lobes[b]);
      EXPECT_LE((1.0 + c) / (1.0 - c), 1.0001e5);
    }
  }
}

TEST(NdfFit, ToleratesDegenerateInput) {
  EXPECT_EQ(fit_ndf({}, 4).lobes.size(), 1U);
  const std::vector<WeightedNormal> one{{{0.6, 0, 0.8}, 3.0}};
  const NdfFit fit = fit_ndf(one, 4);
  ASSERT_EQ(fit.lobes.size(), 1U);
  EXPECT_NEAR(fit.lobes[0].sharpness / sharpest, 1.0, 1e-3);
  const std::vector<WeightedNormal> opposite{{{0, 0, 1}, 1.0}, {{0, 0, -1}, 1.0}};
  for (const SphericalGaussian& lobe : fit_ndf(opposite, 1).lobes) {
    EXPECT_TRUE(std::isfinite(lobe.sharpness + lobe.axis.x + lobe.axis.y + lobe.axis.z));
  }
}

TEST(NdfFit, IsTheSameEachTime) {
  std::mt19937_64 random(1);
  std::vector<WeightedNormal> normals;
  draw({{0, 0, 1}, 20.0}, 5000, 1.0, random, normals);
  EXPECT_EQ(fit_ndf(normals, 6).lobes, fit_ndf(normals, 6).lobes);
}

// The relative error over solid angle of the SGs fitted to a density.
double fit_error(const std::vector<BrdfLobe>& lobes, const std::function<double(double)>& exact) {
  double difference = 0.0, square = 0.0;
  for (int i = 0; i < 20000; ++i) {
    const double w = (i + 0.5) / 20000.0;
    const double u = w * w, du = 2.0 * w / 20000.0;
    difference += du * std::pow(value(lobes, u) - exact(u), 2.0);
    square += du * exact(u) * exact(u);
  }
  return std::sqrt(difference / square);
}

// Beckmann's lobe falls faster than any exponential, the more so the wider it is: no sum of them with positive weights
// follows.
TEST(BrdfLobes, FollowTheBaseLobes) {
  using std::numbers::pi;
  for (const double alpha : {0.05, 0.15, 0.4}) {
    const double a2 = alpha * alpha;
    EXPECT_LT(fit_error(lobes_of(Lobe{NormalDistribution::ggx, alpha}),
                        [a2](double u) {
                          const double c2 = (1 - u) * (1 - u);
                          const double d = a2 * c2 + 1.0 - c2;
                          return a2 / (pi * d * d);
                        }),
              0.02)
        << alpha;
    EXPECT_LT(fit_error(lobes_of(Lobe{NormalDistribution::beckmann, alpha}),
                        [a2](double u) {
                          const double c2 = (1 - u) * (1 - u);
                          return c2 < 1e-6 ? 0.0 : std::exp(-(1.0 / c2 - 1.0) / a2) / (pi * a2 * c2 * c2);
                        }),
              std::max(0.02, 0.5 * alpha * alpha))
        << alpha;
  }
}

// Ward's BRDF from its table: the diffuse term is a lobe of sharpness 0, the rest follows the lobe near normal
// incidence.
TEST(BrdfLobes, OfATableFollowIt) {
  const glm::vec3 diffuse(0.3F, 0.1F, 0.2F), specular(0.2F, 0.5F, 0.0F);
  constexpr double alpha = 0.2;
  const TabulatedBrdf table = ward_brdf(diffuse, specular, alpha);
  const TabulatedLobes fitted = lobes_of(table);
  EXPECT_NEAR(fitted.diffuse.r, diffuse.r / std::numbers::pi, 1e-3);
  ASSERT_EQ(fitted.rise.size(), std::size_t{TabulatedBrdf::theta_d_cells});
  for (const double theta_d : {0.1, 0.3, 0.8, 1.2}) {
    for (const double theta_h : {0.0, 0.05, 0.1, 0.2, 0.3}) {
      glm::dvec3 sum(0.0);
      for (const ColorLobe& lobe : fitted.lobes) {
        sum += glm::dvec3(lobe.amplitude) * std::exp(-lobe.sharpness * (1.0 - std::cos(theta_h)));
      }
      sum = sum * rise_at(fitted, theta_d) + glm::dvec3(fitted.diffuse);
      const glm::dvec3 expected(table.at(theta_h, theta_d, 1.5));
      const double peak = table.at(0.0, theta_d, 1.5).g, bound = theta_d < 1.0 ? 0.035 : 0.08;
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(sum[c], expected[c], bound * peak) << theta_d << " " << theta_h << " " << c;
    }
  }
}

TEST(BrdfLobes, BlinnPhongHasUnitEnergy) {
  for (const double exponent : {4.0, 64.0, 1024.0}) {
    const BrdfLobe lobe = lobes_of(Lobe{NormalDistribution::blinn_phong, exponent}).front();
    EXPECT_NEAR(lobe.amplitude * vmf_integral(lobe.sharpness), 1.0, 1e-4);
  }
}

}  // namespace
}  // namespace footprint::iwasaki_sg
