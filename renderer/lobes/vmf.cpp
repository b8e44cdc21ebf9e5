// Closed forms that neither overflow nor cancel, and series where they would.
#include "renderer/lobes/vmf.hpp"

#include <cmath>
#include <numbers>

namespace footprint {
namespace {

using std::numbers::pi;

constexpr double smallest_amplitude_kappa = 1e-9;  // below it, the limit
constexpr double smallest_kappa = 0.05;            // of the mean: below it, series
constexpr double largest_kappa = 20.0;             // above it, tanh is 1 to the last bit

}  // namespace

double vmf_integral(double kappa) { return kappa > 0.0 ? -2.0 * pi * std::expm1(-2.0 * kappa) / kappa : 4.0 * pi; }

double vmf_peak(double kappa) {
  return kappa < smallest_amplitude_kappa ? 0.25 / pi : kappa / (2.0 * pi * -std::expm1(-2.0 * kappa));
}

double vmf_amplitude(double kappa) {
  if (kappa > largest_kappa) return kappa;  // e^{-2 kappa} is nothing to the last bit
  return kappa < smallest_amplitude_kappa ? 0.5 : kappa / -std::expm1(-2.0 * kappa);
}

VmfMean vmf_mean(double kappa) {
  const double k2 = kappa * kappa;
  if (kappa < smallest_kappa)
    return {1.0 / 3.0 - k2 * (1.0 / 45.0 - k2 * 2.0 / 945.0), -2.0 / 45.0 + k2 * (8.0 / 945.0 - k2 * 2.0 / 1575.0)};
  if (kappa > largest_kappa) return {(1.0 - 1.0 / kappa) / kappa, (2.0 / kappa - 1.0) / (k2 * kappa)};
  const double b = (1.0 / std::tanh(kappa) - 1.0 / kappa) / kappa;
  const double sinh = std::sinh(kappa);
  return {b, (1.0 / k2 - 1.0 / (sinh * sinh) - b) / k2};
}

double vmf_kappa_of_shortfall(double q) { return (1.0 - q) * (2.0 + 2.0 * q - q * q) / (q * (2.0 - q)); }

double vmf_shortfall(double kappa) {
  constexpr int steps = 6;
  double q = kappa >= 1.0 ? 1.0 / (kappa + 0.5) : 1.0 / (1.0 + kappa / 3.0);
  for (int step = 0; step < steps; ++step)
    q -= (((q + kappa - 3.0) * q - 2.0 * kappa) * q + 2.0) / ((3.0 * q + 2.0 * (kappa - 3.0)) * q - 2.0 * kappa);
  return q;
}

}  // namespace footprint
