// Convolved lobes against Xu et al. 2017, equations 11 to 13, and against integrals in double precision.
#include "renderer/lobes/convolution.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace footprint {
namespace {

using enum NormalDistribution;

// The integral of equation 11 at its peak, over rings about the normal: u is 1 minus the cosine of a facet's normal.
double peak_of_integral(const Lobe& lobe, double kappa) {
  constexpr int steps = 40000;
  double sum = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double t = (i + 0.5) / steps, u = t * t * t * t;
    sum += 4.0 * t * t * t / steps * lobe_density(lobe, u) * std::exp(-kappa * u);
  }
  return kappa / -std::expm1(-2.0 * kappa) * sum;
}

double excess_of_peak(const Lobe& base, double kappa) {
  return lobe_density(convolved(base, kappa), 0.0) / peak_of_integral(base, kappa) - 1.0;
}

TEST(ConvolvedLobe, FollowsThePublishedFormula) {
  for (const double s : {0.5, 8.0, 64.0, 200.0, 1e5}) {
    for (const double kappa : {0.25, 16.0, 128.0, 1e6}) {
      const double published = kappa * s / (kappa + s);
      for (const NormalDistribution distribution : {blinn_phong, vmf})
        EXPECT_NEAR(convolved({distribution, s}, kappa).parameter / published, 1.0, 1e-14) << s << " " << kappa;
    }
  }
}

// Equation 13 is an approximation, whose peak is too high by a few per cent.
TEST(ConvolvedLobe, ApproximatesBlinnPhong) {
  for (const auto& [s, kappa, excess] : {std::array{8.0, 8.0, 0.15}, std::array{32.0, 32.0, 0.039},
                                         std::array{128.0, 128.0, 0.0097}, std::array{200.0, 16.0, 0.067}})
    EXPECT_NEAR(excess_of_peak({blinn_phong, s}, kappa), excess, 0.05 * excess) << s << " " << kappa;
}

TEST(ConvolvedLobe, HasThePeakOfTheConvolution) {
  for (const double alpha : {0.02, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.7}) {
    for (const double kappa : {5.0, 8.0, 20.0, 50.0, 200.0, 800.0, 1e4, 1e6}) {
      for (const NormalDistribution distribution : {beckmann, ggx}) {
        if (convolved({distribution, alpha}, kappa).parameter >= 1.0) continue;
        const double most = distribution == beckmann && alpha > 0.4 ? 0.035 : 0.01;
        EXPECT_NEAR(excess_of_peak({distribution, alpha}, kappa), 0.0, most)
            << static_cast<int>(distribution) << " " << alpha << " " << kappa;
      }
    }
  }
}

// Variances do not add for GGX, which has none: alpha^2 + 2 / kappa is too narrow.
TEST(ConvolvedLobe, IsWiderThanTheSumOfVariancesForGgx) {
  for (const auto& [alpha, kappa, excess] :
       {std::array{0.1, 200.0, 0.23}, std::array{0.2, 50.0, 0.21}, std::array{0.4, 20.0, 0.12}}) {
    const Lobe sum{ggx, std::sqrt(alpha * alpha + 2.0 / kappa)};
    EXPECT_NEAR(lobe_density(sum, 0.0) / peak_of_integral({ggx, alpha}, kappa) - 1.0, excess, 0.005);
    EXPECT_NEAR(excess_of_peak({ggx, alpha}, kappa), 0.0, 1e-3);
  }
}

// The plain integral of the convolution is that of the base lobe; a wider microfacet lobe has a larger one.
TEST(ConvolvedLobe, HasTheEnergyOfItsWidth) {
  for (const auto& [alpha, kappa, of_ggx, of_beckmann] :
       {std::array{0.1, 200.0, 0.032, 0.005}, std::array{0.2, 50.0, 0.084, 0.018},
        std::array{0.4, 20.0, 0.119, 0.032}}) {
    for (const auto& [distribution, excess] : {std::pair{ggx, of_ggx}, std::pair{beckmann, of_beckmann}}) {
      const Lobe base{distribution, alpha};
      EXPECT_NEAR(lobe_energy(convolved(base, kappa), 1.0) / lobe_energy(base, 1.0) - 1.0, excess, 0.003) << alpha;
    }
  }
}

TEST(ConvolvedLobe, StaysWithinItsLimits) {
  EXPECT_EQ(convolved({ggx, 0.3}, 0.5).parameter, 1.0);
  EXPECT_EQ(convolved({ggx, 1.0}, 100.0).parameter, 1.0);
  EXPECT_EQ(convolved({beckmann, 1.0}, 1000.0).parameter, 1.0);  // its density rises beside the axis
  for (const NormalDistribution distribution : {beckmann, ggx}) {
    double before = 1e9;
    for (double kappa = 1e-3; kappa < 2e6; kappa *= 1.5) {
      const double alpha = convolved({distribution, 1e-3}, kappa).parameter;
      EXPECT_TRUE(std::isfinite(alpha) && alpha >= 1e-3) << kappa;
      EXPECT_LE(alpha, before) << kappa;
      before = alpha;
    }
    EXPECT_NEAR(convolved({distribution, 0.3}, 1e6).parameter, 0.3, 1e-5);
  }
}

}  // namespace
}  // namespace footprint
