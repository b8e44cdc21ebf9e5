// The worst of figures that are measured one after another.
#pragma once

#include <cmath>

namespace footprint::stability {

/// A NaN is the worst, and no later figure hides it.
inline void keep_worst(double& worst, double value) {
  if (!std::isnan(worst) && !(value <= worst)) worst = value;
}

}  // namespace footprint::stability
