// For tests: q = 1 - |r| of kappa once more.
#pragma once

namespace footprint::testing {

/// Equation 9 in q by bisection in double precision.
[[nodiscard]] inline double shortfall_twin(double kappa) {
  double low = 0;
  double high = 1;
  for (int i = 0; i < 200; ++i) {
    const double q = 0.5 * (low + high);
    (q * q * q + (kappa - 3.0) * q * q - 2.0 * kappa * q + 2.0 > 0.0 ? low : high) = q;
  }
  return low;
}

}  // namespace footprint::testing
