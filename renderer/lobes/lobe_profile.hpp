// A lobe's shape as a table: the exact sum asks for it billions of times, where exp and log would cost most of the
// time.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "renderer/lobes/lobe.hpp"

namespace footprint {

/// `lobe_shape` of one lobe, within 2e-9. Cubics between even nodes in u up to the lobe's support, by the values and
/// slopes there; the lobe itself where a table gains nothing (GGX needs no exponential) or cannot follow (lobes so wide
/// that the horizon cuts them).
class LobeProfile {
 public:
  explicit LobeProfile(const Lobe& lobe);

  [[nodiscard]] double operator()(double u) const {
    if (cubics_.empty()) return lobe_shape(lobe_, u);
    const double position = u * scale_;
    const auto i = static_cast<std::size_t>(position);
    if (i >= cubics_.size()) return 0.0;
    const double t = position - static_cast<double>(i);
    const std::array<double, 4>& c = cubics_[i];
    return ((c[3] * t + c[2]) * t + c[1]) * t + c[0];
  }

 private:
  Lobe lobe_;
  double scale_ = 0.0;  // intervals per u
  std::vector<std::array<double, 4>> cubics_;
};

}  // namespace footprint
