// The von Mises-Fisher mathematics of the shaders against sums in double precision that share no code with them, and
// against their C++ twins.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "renderer/lobes/lobe.hpp"
#include "renderer/pipeline/shader_source.hpp"
#include "tests/support/shader_probe.hpp"

namespace footprint::testing {
namespace {

using std::numbers::pi;
using Inputs = std::vector<std::array<glm::vec4, 3>>;

std::vector<glm::vec4> vmf(const std::string& body, const Inputs& inputs) {
  const ShaderFlags flags = shader_flags({}, Options({}, {}, "test"));
  return evaluate_glsl(shared_functions(flags, {"test.glsl", "#include \"vmf.glsl\"\n"}), body, inputs);
}

// From nearly even to sharper than any lobe; both sides of each threshold are among them.
const std::vector<float> kappas{1e-5F, 9e-5F, 1.1e-4F, 1e-3F, 0.009F, 0.019F, 0.021F, 0.09F, 0.11F, 0.29F, 0.49F,
                                0.51F, 1.0F,  1.83F,   5.0F,  20.0F,  100.0F, 1e3F,   1e4F,  1e5F,  1e6F};

Inputs inputs_of(const std::vector<float>& values) {
  Inputs inputs;
  for (const float value : values) inputs.push_back({glm::vec4(value), glm::vec4(0), glm::vec4(0)});
  return inputs;
}

// The integrals over the sphere of e^{-kappa u} and of the cosine under it, u = 1 - cos, over x with u = 2 / (1 +
// e^-x): evenly spaced steps of x are dense where narrow lobes are.
struct Integrals {
  double mass = 0, cosine = 0;
};

Integrals integrals(double kappa) {
  Integrals sum;
  constexpr int steps = 40000;
  for (int i = 0; i < steps; ++i) {
    const double x = -60.0 + 120.0 * (i + 0.5) / steps;
    const double part = 1.0 / (1.0 + std::exp(-x));
    const double u = 2.0 * part;
    const double weight = 2.0 * pi * std::exp(-kappa * u) * 2.0 * part * (1.0 - part) * 120.0 / steps;
    sum.mass += weight;
    sum.cosine += weight * (1.0 - u);
  }
  return sum;
}

TEST(VonMisesFisher, MeanCosineIsThatOfTheDensity) {
  const auto got = vmf("return vec4(meanCosine(a.x));", inputs_of(kappas));
  for (std::size_t i = 0; i < kappas.size(); ++i) {
    const Integrals exact = integrals(kappas[i]);
    EXPECT_NEAR(got[i].x / (exact.cosine / exact.mass), 1.0, 1e-5) << kappas[i];
  }
}

TEST(VonMisesFisher, DensityHasUnitMass) {
  const auto peaks = vmf("return vec4(vmfDensity(a.x, vec3(0, 0, 1), vec3(0, 0, 1)));", inputs_of(kappas));
  const auto backs = vmf("return vec4(vmfDensity(a.x, vec3(0, 0, 1), vec3(0, 0, -1)));", inputs_of(kappas));
  for (std::size_t i = 0; i < kappas.size(); ++i) {
    const double mass = integrals(kappas[i]).mass;
    EXPECT_NEAR(peaks[i].x * mass, 1.0, 3e-5) << kappas[i];
    EXPECT_NEAR(backs[i].x * mass, std::exp(-2.0 * kappas[i]), 3e-5) << kappas[i];
  }
}

// Banerjee's approximation: within 2% of the mean resultant length where lobes are not wider than it is made for.
TEST(VonMisesFisher, ShortfallAndKappaAreInverse) {
  const auto back = vmf("return vec4(kappaOf(shortfallOf(a.x)), shortfallOf(a.x), 0, 0);", inputs_of(kappas));
  for (std::size_t i = 0; i < kappas.size(); ++i) {
    if (kappas[i] >= 0.01F) {
      EXPECT_NEAR(back[i].x / kappas[i], 1.0, 1e-4) << kappas[i];
    }
    const double r = 1.0 - back[i].y;
    const Integrals exact = integrals(kappas[i]);
    EXPECT_NEAR(r, exact.cosine / exact.mass, 0.02) << kappas[i];
  }
}

TEST(VonMisesFisher, ShadersMeetTheirTwins) {
  const auto of_kappa =
      vmf("return vec4(meanCosine(a.x), vmfDensity(a.x, vec3(0, 0, 1), vec3(0, 0, 1)), shortfallOf(a.x), 0);",
          inputs_of(kappas));
  for (std::size_t i = 0; i < kappas.size(); ++i) {
    const double kappa = kappas[i];
    EXPECT_NEAR(of_kappa[i].x / (kappa * vmf_mean(kappa).by_kappa), 1.0, 1e-5) << kappa;
    EXPECT_NEAR(of_kappa[i].y / vmf_peak(kappa), 1.0, 1e-4) << kappa;
    EXPECT_NEAR(of_kappa[i].z / vmf_shortfall(kappa), 1.0, 1e-4) << kappa;
  }
  const std::vector<float> shortfalls{1e-6F, 1e-4F, 0.01F, 0.2F, 0.5F, 0.9F, 0.999F};
  const auto of_shortfall = vmf("return vec4(kappaOf(a.x));", inputs_of(shortfalls));
  for (std::size_t i = 0; i < shortfalls.size(); ++i)
    EXPECT_NEAR(of_shortfall[i].x / vmf_kappa_of_shortfall(shortfalls[i]), 1.0, 1e-5) << shortfalls[i];
}

TEST(VonMisesFisher, NormalDistributionFunctionMeetsTheErrorFunction) {
  std::vector<float> values;
  for (int i = -60; i <= 60; ++i) values.push_back(0.1F * static_cast<float>(i));
  const auto got = vmf("return vec4(normalCdf(a.x), inverse_root_two_pi, 0, 0);", inputs_of(values));
  for (std::size_t i = 0; i < values.size(); ++i) {
    EXPECT_NEAR(got[i].x, 0.5 * std::erfc(-values[i] / std::numbers::sqrt2), 1.5e-4) << values[i];
    EXPECT_NEAR(got[i].y, 1.0 / std::sqrt(2.0 * pi), 1e-7);
  }
}

}  // namespace
}  // namespace footprint::testing
