// Lobes and products of spherical Gaussians: finite, positive, and what conversions give back.
#include <algorithm>
#include <iostream>
#include <sstream>

#include "methods/iwasaki_sg/spherical_gaussian.hpp"
#include "renderer/lobes/lobe.hpp"
#include "tests/properties/inputs.hpp"

namespace footprint::testing {
namespace {

using iwasaki_sg::SphericalGaussian;

Lobe any_lobe() {
  const auto distribution = *rc::gen::element(NormalDistribution::blinn_phong, NormalDistribution::beckmann,
                                              NormalDistribution::ggx, NormalDistribution::vmf);
  const bool by_alpha = distribution == NormalDistribution::beckmann || distribution == NormalDistribution::ggx;
  return {distribution, by_alpha ? magnitude(smallest_alpha, 1.0) : magnitude(1e-3, 1e6)};
}

SphericalGaussian any_gaussian() { return {direction(), magnitude(1e-3, 1e6)}; }

// Beckmann's density exp(-tan^2 / alpha^2) / cos^4 rises from its normal if alpha > 1 / sqrt 2, since its slope in u =
// 1 - cos is 4 - 2 / alpha^2 there. What falls then is the exponential.
double falling_part(const Lobe& lobe, double u) {
  const bool rises = lobe.distribution == NormalDistribution::beckmann && lobe.parameter > std::sqrt(0.5);
  return lobe_shape(lobe, u) * (rises ? std::pow(std::max(1.0 - u, 0.0), 4.0) : 1.0);
}

TEST(LobeProperties, OnlyWideBeckmannLobesRiseFromTheirNormal) {
  EXPECT_GT(lobe_shape({NormalDistribution::beckmann, 0.8}, 0.1), 1.0);
  EXPECT_LT(lobe_shape({NormalDistribution::beckmann, 0.7}, 1e-3), 1.0);
}

RC_GTEST_PROP(LobeProperties, FallFromOneAtTheirNormal, ()) {
  const Lobe lobe = any_lobe();
  const double near = number(0.0, 2.0), far = number(near, 2.0);
  const double at_near = falling_part(lobe, near), at_far = falling_part(lobe, far);
  RC_ASSERT(std::abs(lobe_shape(lobe, 0.0) - 1.0) <= 1e-12);
  RC_ASSERT(std::isfinite(at_near) && at_far >= 0.0 && at_near <= 1.0 + 1e-12);
  RC_ASSERT(at_far <= at_near * (1.0 + 1e-9) + 1e-300);
}

RC_GTEST_PROP(LobeProperties, ArePositiveAndFiniteAtTheirPeak, ()) {
  const Lobe lobe = any_lobe();
  RC_ASSERT(std::isfinite(lobe_peak(lobe)) && lobe_peak(lobe) > 0.0);
  RC_ASSERT(lobe_width(lobe) > 0.0 && lobe_support(lobe) > 0.0 && lobe_support(lobe) <= 2.0);
}

RC_GTEST_PROP(LobeProperties, ComeBackFromTheirVariance, ()) {
  const Lobe lobe = any_lobe();
  const float variance = lobe_variance(lobe);
  RC_ASSERT(std::isfinite(variance) && variance > 0.0F);
  const float again = lobe_variance(lobe_from_variance(lobe.distribution, variance));
  RC_ASSERT(std::abs(again - variance) <= 2e-6F * variance);
}

RC_GTEST_PROP(LobeProperties, ReadWhatTheyWrite, ()) {
  const Lobe lobe = any_lobe();
  const Lobe again = parse_lobe("lobe", lobe_text(lobe));
  RC_ASSERT(again.distribution == lobe.distribution);
  RC_ASSERT(std::abs(again.parameter - lobe.parameter) <= 1e-5 * lobe.parameter);
}

RC_GTEST_PROP(VonMisesFisherProperties, ComeBackFromTheirShortfall, ()) {
  const double kappa = magnitude(1e-3, 1e6);
  const double q = vmf_shortfall(kappa);
  RC_ASSERT(q > 0.0 && q <= 1.0);
  RC_ASSERT(std::abs(vmf_kappa_of_shortfall(q) - kappa) <= 1e-9 * std::max(kappa, 1.0));
}

RC_GTEST_PROP(VonMisesFisherProperties, HaveUnitEnergy, ()) {
  const double kappa = magnitude(1e-8, 1e6);
  RC_ASSERT(std::abs(vmf_peak(kappa) * vmf_integral(kappa) - 1.0) <= 1e-12);
  RC_ASSERT(std::abs(2.0 * std::numbers::pi * vmf_peak(kappa) - vmf_amplitude(kappa)) <= 1e-9 * vmf_amplitude(kappa));
}

RC_GTEST_PROP(ProductsOfGaussians, AreSymmetricAndNoLargerThanEither, ()) {
  const SphericalGaussian a = any_gaussian(), b = any_gaussian();
  const double ab = convolution(a, b);
  RC_ASSERT(std::isfinite(ab) && ab >= 0.0);
  RC_ASSERT(std::abs(ab - convolution(b, a)) <= 1e-12 * ab);
  const double either = std::min(vmf_integral(a.sharpness), vmf_integral(b.sharpness));
  RC_ASSERT(ab <= either * (1.0 + 1e-9));
}

RC_GTEST_PROP(ProductsOfGaussians, AreOneGaussianWithinTheStatedError, ()) {
  const SphericalGaussian a{direction(), magnitude(5.0, 1e6)}, b{direction(), magnitude(5.0, 1e6)};
  const double sum = a.sharpness + b.sharpness;
  RC_ASSERT(std::abs(approximate_convolution(a, b) - convolution(a, b)) <= 1.6 / (sum * sum));
}

// A false property is found: the limit's bound is wrong for wide Gaussians.
TEST(ProductsOfGaussiansFalse, IsFoundByRandomInputs) {
  std::ostringstream said;
  std::streambuf* const before = std::cerr.rdbuf(said.rdbuf());
  const bool passed = rc::check([] {
    const SphericalGaussian a{direction(), 5.0}, b{direction(), 5.0};
    RC_ASSERT(std::abs(approximate_convolution(a, b) - convolution(a, b)) <= 1.45 / 100.0);
  });
  std::cerr.rdbuf(before);
  EXPECT_FALSE(passed);
  EXPECT_NE(said.str().find("Falsifiable"), std::string::npos) << said.str();
}

}  // namespace
}  // namespace footprint::testing
