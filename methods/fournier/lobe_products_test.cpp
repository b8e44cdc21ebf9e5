// Products of lobes against the integral over the sphere, and their derivatives against differences.
#include "methods/fournier/peaks.hpp"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <cmath>
#include <functional>
#include <numbers>

namespace footprint::fournier {
namespace {

using std::numbers::pi;

Eigen::Vector3d direction(double theta, double phi) {
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

VmfLobe lobe_at(double theta, double phi, double kappa) {
  return {.axis = direction(theta, phi),
          .kappa = kappa,
          .axis_by_s = direction(theta + pi / 2, phi),
          .axis_by_t = std::sin(theta) * direction(pi / 2, phi + pi / 2)};
}

double density(const VmfLobe& lobe, const Eigen::Vector3d& h) {
  const double peak = lobe.kappa / (2 * pi * -std::expm1(-2 * lobe.kappa));
  return peak * std::exp(-0.5 * lobe.kappa * (lobe.axis - h).squaredNorm());
}

// The integral over the sphere of a function, by midpoints about an axis and denser near to it.
double integral(const Eigen::Vector3d& axis, const std::function<double(const Eigen::Vector3d&)>& f) {
  constexpr int rings = 2000;
  constexpr int steps = 128;
  const Eigen::Vector3d s = axis.unitOrthogonal();
  const Eigen::Vector3d t = axis.cross(s);
  double sum = 0;
  for (int i = 0; i < rings; ++i) {
    const double x = (i + 0.5) / rings;
    const double theta = pi * x * x;
    double ring = 0;
    for (int j = 0; j < steps; ++j) {
      const double phi = 2 * pi * j / steps;
      ring += f(std::cos(theta) * axis + std::sin(theta) * (std::cos(phi) * s + std::sin(phi) * t));
    }
    sum += ring * std::sin(theta) * 2 * pi * x / rings;
  }
  return sum * 2 * pi / steps;
}

struct Case {
  double theta_a, kappa_a, theta_b, kappa_b;
};
constexpr std::array<Case, 7> cases{{{0.0, 0.01, 2.0, 0.02},
                                     {0.3, 0.5, 1.0, 3.0},
                                     {0.2, 20.0, 0.5, 8.0},
                                     {0.7, 60.0, 0.7, 60.0},
                                     {0.1, 400.0, 0.15, 100.0},
                                     {1.2, 1.0, 1.2 + pi, 1.0},
                                     {0.0, 5.0, 0.4, 21.0}}};

TEST(LobeProducts, EqualTheIntegralOverTheSphere) {
  for (const Case& c : cases) {
    const VmfLobe a = lobe_at(c.theta_a, 0.4, c.kappa_a);
    const VmfLobe b = lobe_at(c.theta_b, 0.9, c.kappa_b);
    const VmfLobe& narrow = a.kappa > b.kappa ? a : b;
    const double expected =
        integral(narrow.axis, [&](const Eigen::Vector3d& h) { return density(a, h) * density(b, h); });
    EXPECT_NEAR(product(a, b) / expected, 1.0, 1e-5) << c.kappa_a << " " << c.kappa_b;
  }
}

// Golden (hard cases 1 to 3): literal forms overflow, or lose 0.7% to cancellation at a million.
TEST(LobeProducts, AreStableForNarrowAndOppositeLobes) {
  const VmfLobe up = lobe_at(0.0, 0.0, 1.1e6);
  EXPECT_NEAR(product(up, up) / (1.1e6 / (4 * pi)), 1.0, 1e-9);
  EXPECT_EQ(product(up, lobe_at(pi, 0.0, 1.1e6)), 0.0);
  const double peaks = 1.0 / (2 * pi * -std::expm1(-2.0)) / (2 * pi * -std::expm1(-2.0));
  EXPECT_NEAR(product(lobe_at(0.0, 0.0, 1.0), lobe_at(pi, 0.0, 1.0)), peaks * 4 * pi * std::exp(-2.0), 1e-12);
}

// VmfLobe a with one of its parameters moved: 1 kappa, 2 theta, 3 phi.
double moved_product(const Case& c, int parameter_a, double by_a, int parameter_b, double by_b) {
  const auto moved = [](double theta, double phi, double kappa, int parameter, double by) {
    return lobe_at(theta + (parameter == 2 ? by : 0.0), phi + (parameter == 3 ? by : 0.0),
                   kappa * (1.0 + (parameter == 1 ? by : 0.0)));
  };
  return product(moved(c.theta_a, 0.4, c.kappa_a, parameter_a, by_a),
                 moved(c.theta_b, 0.9, c.kappa_b, parameter_b, by_b));
}

TEST(LobeProducts, DerivativesEqualDifferences) {
  constexpr double step = 1e-4;
  for (const Case& c : cases) {
    const VmfLobe a = lobe_at(c.theta_a, 0.4, c.kappa_a);
    const VmfLobe b = lobe_at(c.theta_b, 0.9, c.kappa_b);
    const Eigen::Matrix4d products = products_of_derivatives(a, b);
    const Eigen::Vector4d column = products_with_derivatives(a, b);
    const auto scale = [](int parameter, double kappa) { return parameter == 1 ? kappa : 1.0; };
    for (int i = 0; i < 4; ++i) {
      EXPECT_NEAR(column[i], products(i, 0), 1e-12 * products.cwiseAbs().maxCoeff());
      for (int j = 0; j < 4; ++j) {
        double expected = moved_product(c, i, step, j, step);
        if (i > 0) expected = (expected - moved_product(c, i, -step, j, step)) / (2 * step);
        if (j > 0) {
          double behind = moved_product(c, i, step, j, -step);
          if (i > 0) behind = (behind - moved_product(c, i, -step, j, -step)) / (2 * step);
          expected = (expected - behind) / (2 * step);
        }
        const double found = products(i, j) * scale(i, c.kappa_a) * scale(j, c.kappa_b);
        const double size = product(a, b) * std::max({1.0, c.kappa_a, c.kappa_b});
        EXPECT_NEAR(found, expected, 2e-4 * size) << c.kappa_a << " " << c.kappa_b << ": " << i << ", " << j;
      }
    }
  }
}

}  // namespace
}  // namespace footprint::fournier
