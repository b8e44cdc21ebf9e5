// Anisotropic lobes against what defines them: the formula of KHR_materials_anisotropy, projected areas of one, and
// the round lobe.
#include "renderer/lobes/lobe.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace footprint {
namespace {

using std::numbers::pi;
constexpr std::array both{NormalDistribution::beckmann, NormalDistribution::ggx};

TEST(AnisotropicLobe, HasTheAlphasOfKhrMaterialsAnisotropy) {
  const Alphas alphas = anisotropic_alphas(0.6, 0.25);
  EXPECT_DOUBLE_EQ(alphas.along, 0.25 * (1.0 - 0.36) + 0.36);  // mix(alphaRoughness, 1.0, strength^2)
  EXPECT_DOUBLE_EQ(alphas.across, 0.25);
  EXPECT_EQ(anisotropic_alphas(0.0, 0.25), (Alphas{0.25, 0.25}));
  EXPECT_EQ(anisotropic_alphas(1.0, 0.25), (Alphas{1.0, 0.25}));
}

TEST(AnisotropicLobe, IsRecoveredFromItsRoundMean) {
  for (const double strength : {0.0, 0.1, 0.5, 0.9, 1.0}) {
    for (const double alpha : {0.001, 0.02, 0.3, 1.0}) {
      const Alphas alphas = anisotropic_alphas(strength, alpha);
      const Alphas recovered = alphas_of_stretch(round_alpha(alphas), stretch_of(alphas, 0.4));
      EXPECT_NEAR(recovered.across / alphas.across, 1.0, 1e-9) << strength << " " << alpha;
      EXPECT_NEAR(recovered.along / alphas.along, 1.0, 1e-9) << strength << " " << alpha;
    }
  }
  EXPECT_EQ(alphas_of_stretch(0.5, {0.0, -1.0}).across, smallest_alpha);
  EXPECT_NEAR(rotation_of_stretch(stretch_of({0.5, 0.2}, 0.7)), 0.7, 1e-12);
  EXPECT_EQ(stretch_of({0.3, 0.3}, 0.7), glm::dvec2(0.0));
}

// The projected area of the facets, by rings of equal steps in the logarithm of tan.
double projected_area(NormalDistribution distribution, const Alphas& alphas) {
  constexpr int rings = 1000, spokes = 720;
  const double first = std::log(1e-4 * alphas.across), step = (std::log(1e4) - first) / rings;
  double sum = 0.0;
  for (int i = 0; i < rings; ++i) {
    const double tangent = std::exp(first + (i + 0.5) * step), c = 1.0 / std::sqrt(1.0 + tangent * tangent);
    for (int j = 0; j < spokes; ++j) {
      const double azimuth = 2.0 * pi * (j + 0.5) / spokes, s = tangent * c;
      const glm::dvec3 h(s * std::cos(azimuth), s * std::sin(azimuth), c);
      // dw = sin dtheta dphi = c^3 tan^2 dlog(tan) dphi
      sum += anisotropic_density(distribution, alphas, 0.7, h) * c * c * c * c * tangent * tangent;
    }
  }
  return sum * step * 2.0 * pi / spokes;
}

TEST(AnisotropicLobe, HasAProjectedAreaOfOne) {
  for (const NormalDistribution distribution : both) {
    for (const Alphas alphas : {Alphas{0.3, 0.3}, Alphas{0.5, 0.1}, Alphas{1.0, 0.05}})
      EXPECT_NEAR(projected_area(distribution, alphas), 1.0, 2e-4) << alphas.along << " " << alphas.across;
  }
}

TEST(AnisotropicLobe, IsTheRoundLobeWhereBothAlphasAreEqual) {
  for (const NormalDistribution distribution : both) {
    for (const double tilt : {0.0, 0.1, 0.8, 1.5}) {
      const glm::dvec3 h(std::sin(tilt) * std::cos(1.3), std::sin(tilt) * std::sin(1.3), std::cos(tilt));
      const double round = lobe_density({distribution, 0.2}, 1.0 - std::cos(tilt));
      EXPECT_NEAR(anisotropic_density(distribution, {0.2, 0.2}, 0.4, h), round, 1e-9 * (1.0 + round)) << tilt;
    }
  }
}

// Along its direction the lobe is the round one of that alpha, but for the peak; a quarter turn swaps the axes.
TEST(AnisotropicLobe, TurnsWithItsRotation) {
  const glm::dvec3 h(0.28, 0.0, 0.96), turned(0.0, 0.28, 0.96);
  for (const NormalDistribution distribution : both) {
    const double along = anisotropic_density(distribution, {0.5, 0.1}, 0.0, h);
    EXPECT_NEAR(along, 5.0 * lobe_density({distribution, 0.5}, 0.04), 1e-9 * along);
    EXPECT_NEAR(anisotropic_density(distribution, {0.5, 0.1}, 0.5 * pi, turned), along, 1e-9 * along);
    EXPECT_NEAR(anisotropic_density(distribution, {0.1, 0.5}, 0.5 * pi, h), along, 1e-9 * along);
    EXPECT_LT(anisotropic_density(distribution, {0.5, 0.1}, 0.5 * pi, h), 0.5 * along);
  }
}

}  // namespace
}  // namespace footprint
