// The von Mises-Fisher lobe against sums over the sphere, and its inverses against themselves.
#include "renderer/lobes/lobe.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace footprint {
namespace {

using std::numbers::pi;

// The integral over the sphere of e^{kappa (cos - 1)} cos^power, by the midpoint rule in w, cos = 1 - 2 w^3.
double sum_over_sphere(double kappa, int power) {
  constexpr int nodes = 200'000;
  double sum = 0.0;
  for (int i = 0; i < nodes; ++i) {
    const double w = (i + 0.5) / nodes;
    const double u = 2.0 * w * w * w;
    sum += std::exp(-kappa * u) * std::pow(1.0 - u, power) * 6.0 * w * w;
  }
  return 2.0 * pi * sum / nodes;
}

constexpr double kappas[]{0.0, 1e-10, 1e-3, 0.049, 0.051, 0.7, 4.0, 19.9, 20.1, 300.0};

TEST(Vmf, IntegralPeakAndAmplitudeAreOfUnitEnergy) {
  for (const double kappa : kappas) {
    const double whole = sum_over_sphere(kappa, 0);
    EXPECT_NEAR(vmf_integral(kappa), whole, 1e-6 * whole) << kappa;
    EXPECT_NEAR(vmf_peak(kappa) * whole, 1.0, 1e-6) << kappa;
    EXPECT_NEAR(vmf_amplitude(kappa) * whole, 2.0 * pi, 1e-5) << kappa;
  }
}

TEST(Vmf, MeanIsThatOfTheSphere) {
  for (const double kappa : kappas) {
    EXPECT_NEAR(kappa * vmf_mean(kappa).by_kappa, sum_over_sphere(kappa, 1) / sum_over_sphere(kappa, 0), 1e-6);
  }
}

// Central differences, across both borders between series and closed forms too.
TEST(Vmf, SlopeOfTheMeanIsItsDerivative) {
  for (const double kappa : {0.01, 0.05, 0.7, 4.0, 20.0, 300.0}) {
    const double step = 1e-3 * kappa;
    const double rise = vmf_mean(kappa + step).by_kappa - vmf_mean(kappa - step).by_kappa;
    const double expected = rise / (2.0 * step) / kappa;
    EXPECT_NEAR(vmf_mean(kappa).slope_by_kappa, expected, 1e-4 * std::abs(expected)) << kappa;
  }
}

TEST(Vmf, ShortfallAndKappaAreInverse) {
  for (double kappa = 1e-2; kappa < 1e6; kappa *= 1.7) {
    const double q = vmf_shortfall(kappa);
    EXPECT_GT(q, 0.0);
    EXPECT_LE(q, 1.0);
    EXPECT_NEAR(vmf_kappa_of_shortfall(q), kappa, 1e-9 * kappa);
  }
  EXPECT_NEAR(vmf_shortfall(0.0), 1.0, 1e-12);
}

}  // namespace
}  // namespace footprint
