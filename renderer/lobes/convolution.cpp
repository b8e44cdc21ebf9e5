// Integrates over u = 1 - cos of the angle to the axis, in closed form.
#include "renderer/lobes/convolution.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace footprint {
namespace {

// e^x E_n(x) for n of 1 to 3.
struct ExponentialIntegrals {
  double first, second, third;
};

// By the continued fraction (Abramowitz and Stegun, 5.1.22).
double by_fraction(int n, double x) {
  double tail = x;
  for (int i = 60; i > 0; --i) tail = x + (n + i - 1) / (1.0 + i / tail);
  return 1.0 / tail;
}

ExponentialIntegrals exponential_integrals(double x) {
  if (x >= 1.5) return {by_fraction(1, x), by_fraction(2, x), by_fraction(3, x)};
  double sum = -std::numbers::egamma - std::log(x);  // of the power series
  double power = 1.0;
  for (int i = 1; i <= 25; ++i) {
    power *= -x / i;
    sum -= power / i;
  }
  const double first = std::exp(x) * sum, second = 1.0 - x * first;
  return {first, second, 0.5 * (1.0 - x * second)};
}

// The alpha of the GGX lobe with the peak. Pi times the density at the axis is the integral over u of
// kappa e^{-kappa u} alpha^2 / (alpha^2 + 2 b u - b u^2)^2 with b = 1 - alpha^2, to the first order in the last term.
double ggx_alpha(double alpha, double kappa) {
  const double b = 1.0 - alpha * alpha;
  if (b < 1e-6) return 1.0;
  const double x = 0.5 * kappa * alpha * alpha / b;
  const auto [first, second, third] = exponential_integrals(x);
  return 1.0 / std::sqrt((kappa * second + x * (first - 2.0 * second + third)) / (2.0 * b));
}

// The alpha of the Beckmann lobe with the peak, from e^{-tan^2 / alpha^2} / (alpha^2 cos^4), with tan^2 = 2 u + 3 u^2
// and 1 / cos^4 = 1 + 4 u to the first order beyond a Gaussian in the angle.
double beckmann_alpha(double alpha, double kappa) {
  const double alpha2 = alpha * alpha;
  const double narrowness = 2.0 / alpha2 + kappa;  // of the Gaussian in u
  const double excess = (4.0 - 6.0 / (alpha2 * narrowness)) / narrowness;
  return std::sqrt((alpha2 + 2.0 / kappa) / (1.0 + excess));
}

}  // namespace

Lobe convolved(const Lobe& base, double kappa) {
  const double own = base.parameter;
  switch (base.distribution) {
    case NormalDistribution::blinn_phong:
    case NormalDistribution::vmf:
      return {base.distribution, kappa * own / (kappa + own)};
    case NormalDistribution::beckmann:
      return {base.distribution, std::max(beckmann_alpha(own, kappa), own)};
    case NormalDistribution::ggx:
      break;
  }
  return {base.distribution, std::min(std::max(ggx_alpha(own, kappa), own), 1.0)};
}

}  // namespace footprint
