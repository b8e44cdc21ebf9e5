// The brute force behind `fit`, against what is known in closed form; and the table that came of it.
#include "methods/roughness_bake/study/best_constant.hpp"

#include <gtest/gtest.h>

#include "methods/roughness_bake/presets.hpp"

namespace footprint::roughness_bake {
namespace {

// Narrow Gaussians of slopes add: a Beckmann lobe over Gaussian slopes is one of alpha^2 + 2 sigma^2.
TEST(BestConstant, IsTwoForNarrowGaussians) {
  const std::array<double, 1> sigma{0.02};
  EXPECT_NEAR(best_constant(NormalDistribution::beckmann, 0.05, sigma), 2.0, 0.02);
  EXPECT_LT(WidenedLobe(NormalDistribution::beckmann, 0.05, 0.02).error(2.0), 0.005);
  EXPECT_GT(WidenedLobe(NormalDistribution::beckmann, 0.05, 0.02).error(1.0), 0.05);
}

// What the table of `fit` says is what is measured.
TEST(BestConstant, IsWhatTheTableOfFitSays) {
  for (const NormalDistribution distribution : {NormalDistribution::ggx, NormalDistribution::vmf}) {
    for (const std::size_t i : {1U, 4U}) {
      const double alpha = 0.1 * static_cast<double>(i);
      EXPECT_NEAR(best_constant(distribution, alpha, fit_sigmas), fit_table(distribution)[i], 0.006) << alpha;
    }
  }
}

// Engines differ by four in the constant, and one of them is right.
TEST(BestConstant, LeavesLessThanEnginesOwn) {
  const WidenedLobe lobe(NormalDistribution::ggx, 0.1, 0.2);
  const double fit = lobe.error(fit_table(NormalDistribution::ggx)[1]);
  EXPECT_LT(fit, 0.2);
  EXPECT_GT(lobe.error(0.5), 4 * fit);
  EXPECT_GT(lobe.error(1.0), 2 * fit);
}

}  // namespace
}  // namespace footprint::roughness_bake
