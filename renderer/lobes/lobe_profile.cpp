// Cubics by values and slopes at even nodes.
#include "renderer/lobes/lobe_profile.hpp"

namespace footprint {
namespace {

constexpr std::size_t intervals = 1024;  // 28 e-foldings: steps of 0.027, of which a cubic errs by 0.027^4 / 384
constexpr double widest = 0.35;          // radians: the support ends well above the horizon

}  // namespace

LobeProfile::LobeProfile(const Lobe& lobe) : lobe_(lobe) {
  if (lobe.distribution == NormalDistribution::ggx || lobe_width(lobe) > widest) return;
  const double step = lobe_support(lobe) / intervals;
  scale_ = 1.0 / step;
  const double nudge = 1e-4;  // of a step, for slopes by central differences
  const auto shape = [&](double node) { return lobe_shape(lobe, node * step); };
  const auto slope = [&](double node) {
    if (node == 0.0) return (4.0 * shape(nudge) - shape(2.0 * nudge) - 3.0 * shape(0.0)) / (2.0 * nudge);
    return (shape(node + nudge) - shape(node - nudge)) / (2.0 * nudge);
  };
  cubics_.reserve(intervals);
  for (std::size_t i = 0; i < intervals; ++i) {
    const double a = static_cast<double>(i), b = a + 1.0;
    const double rise = shape(b) - shape(a);
    const double slope_a = slope(a), slope_b = slope(b);
    cubics_.push_back({shape(a), slope_a, 3.0 * rise - 2.0 * slope_a - slope_b, slope_a + slope_b - 2.0 * rise});
  }
}

}  // namespace footprint
