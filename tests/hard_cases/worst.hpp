// The worst of several figures.
#pragma once

#include <cmath>

namespace footprint::hard_cases {

/// Replaces `worst` by a larger `value`. A NaN is the worst and stays.
inline void keep_worst(double& worst, double value) {
  if (!std::isnan(worst) && !(value <= worst)) worst = value;
}

}  // namespace footprint::hard_cases
