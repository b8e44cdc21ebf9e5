// The GLSL distributions against golden numbers, numerical integrals and their C++ twins.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "renderer/pipeline/shader_source.hpp"
#include "tests/support/shader_probe.hpp"

namespace footprint::testing {
namespace {

using Inputs = std::vector<std::array<glm::vec4, 3>>;
using std::numbers::pi;

std::string functions_of(const BaseBrdf& brdf) {
  ShaderVariant variant;
  variant.brdf = brdf;
  variant.effects.set();
  for (const Effect own_test : {Effect::multi_lobe, Effect::anisotropic_lobe})  // facet_lobes_test.cpp and its like
    variant.effects.reset(static_cast<std::size_t>(own_test));
  return shared_functions(shader_flags(variant, Options({}, {}, "test")));
}

std::string functions_of(NormalDistribution distribution) {
  return functions_of({distribution, GeometryTerm::none, FresnelTerm::none, true});
}

glm::vec3 direction(double theta, double phi = 0.3) {
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

// D at angles from the axis (0, 0, 1).
std::vector<double> densities(NormalDistribution distribution, double lobe, const std::vector<double>& thetas) {
  Inputs inputs;
  for (const double theta : thetas)
    inputs.push_back({glm::vec4(static_cast<float>(lobe)), glm::vec4(0, 0, 1, 0), glm::vec4(direction(theta), 0)});
  std::vector<double> out;
  for (const glm::vec4& v :
       evaluate_glsl(functions_of(distribution), "return vec4(lobeDensity(a.x, b.xyz, normalize(c.xyz)));", inputs))
    out.push_back(v.x);
  return out;
}

// int D(theta) cos^power sin 2 pi dtheta over the hemisphere, Simpson's rule on t = theta^(1/3): dense where lobes are
// narrow.
double energy(NormalDistribution distribution, double lobe, int power, double largest_theta = pi / 2) {
  constexpr int steps = 4000;
  std::vector<double> thetas;
  for (int i = 0; i <= steps; ++i) thetas.push_back(largest_theta * std::pow(static_cast<double>(i) / steps, 3.0));
  const std::vector<double> d = densities(distribution, lobe, thetas);
  double sum = 0;
  for (int i = 0; i <= steps; ++i) {
    const double t = static_cast<double>(i) / steps;
    const double weight = i == 0 || i == steps ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
    const double theta = thetas[static_cast<std::size_t>(i)];
    sum += weight * d[static_cast<std::size_t>(i)] * std::pow(std::cos(theta), power) * std::sin(theta) *
           largest_theta * 3.0 * t * t;
  }
  return sum * 2.0 * pi / (3.0 * steps);
}

TEST(Lobes, BlinnPhongHasUnitEnergyOverSolidAngle) {
  for (const double s : {0.0, 1.0, 16.0, 512.0, 1e4, 1e5})
    EXPECT_NEAR(energy(NormalDistribution::blinn_phong, s, 0), 1.0, 1e-3) << s;
}

TEST(Lobes, VmfHasUnitEnergyOverTheSphere) {
  for (const double kappa : {1e-5, 1e-3, 0.02, 0.5, 4.0, 128.0, 1e4, 1e6}) {
    EXPECT_NEAR(energy(NormalDistribution::vmf, kappa, 0, pi), 1.0, 1e-3) << kappa;
  }
}

TEST(Lobes, MicrofacetDistributionsProjectToUnitArea) {
  for (const double alpha : {1e-3, 0.03, 0.3, 1.0}) {
    EXPECT_NEAR(energy(NormalDistribution::ggx, alpha, 1), 1.0, 2e-3) << alpha;
    EXPECT_NEAR(energy(NormalDistribution::beckmann, alpha, 1), 1.0, 2e-3) << alpha;
  }
}

TEST(Lobes, KnowTheirEnergyOverSolidAngle) {
  const auto claimed = [](NormalDistribution distribution, double lobe) {
    return evaluate_glsl(functions_of(distribution), "return vec4(lobeEnergy(a.x));",
                         Inputs{{glm::vec4(static_cast<float>(lobe)), {}, {}}})
        .front()
        .x;
  };
  EXPECT_EQ(claimed(NormalDistribution::blinn_phong, 64.0), 1.0F);
  EXPECT_EQ(claimed(NormalDistribution::vmf, 64.0), 1.0F);
  for (const double alpha : {1e-3, 0.03, 0.3, 0.6, 0.9, 0.9999, 1.0}) {
    EXPECT_NEAR(claimed(NormalDistribution::ggx, alpha), energy(NormalDistribution::ggx, alpha, 0), 2e-3) << alpha;
    EXPECT_NEAR(claimed(NormalDistribution::beckmann, alpha), energy(NormalDistribution::beckmann, alpha, 0), 2e-3)
        << alpha;
  }
  EXPECT_NEAR(claimed(NormalDistribution::beckmann, 2.0) / energy(NormalDistribution::beckmann, 2.0, 0), 1.0, 5e-3);
}

// Hard cases 5 and 6: within 1e-4 of the exact value over the lobe for exponents up to 1e6, and no NaN far from the
// axis.
TEST(Lobes, NarrowLobesKeepTheirShape) {
  for (const double s : {1e3, 1e5, 1e6}) {
    std::vector<double> thetas;
    for (int i = 0; i <= 40; ++i) thetas.push_back(i * 0.1 / std::sqrt(s));
    const std::vector<double> bp = densities(NormalDistribution::blinn_phong, s, thetas);
    const std::vector<double> vmf = densities(NormalDistribution::vmf, s, thetas);
    for (std::size_t i = 0; i < thetas.size(); ++i) {
      // The exact angle between the rounded vectors that the shader got
      const glm::dvec3 h = glm::normalize(glm::dvec3(direction(thetas[i])));
      const double u = 0.5 * glm::dot(h - glm::dvec3(0, 0, 1), h - glm::dvec3(0, 0, 1));
      const double exact_bp = (s + 1) / (2 * pi) * std::exp(s * std::log1p(-u));
      const double exact_vmf = s / (2 * pi) * std::exp(-s * u);
      EXPECT_NEAR(bp[i] / exact_bp, 1.0, 1.5e-3) << s << " at " << thetas[i];
      EXPECT_NEAR(vmf[i] / exact_vmf, 1.0, 1.5e-3) << s << " at " << thetas[i];
    }
  }
  EXPECT_EQ(densities(NormalDistribution::blinn_phong, 1e5, {1.2, 2.0, pi}), (std::vector<double>{0, 0, 0}));
  EXPECT_EQ(densities(NormalDistribution::beckmann, 1e-3, {1.2, 2.0, pi}), (std::vector<double>{0, 0, 0}));
}

// Hard case 4: kappa = 0 is the uniform density.
TEST(Lobes, VmfOfNoConcentrationIsUniform) {
  EXPECT_NEAR(densities(NormalDistribution::vmf, 0.0, {0.7}).front(), 0.0795775, 1e-6);
  EXPECT_NEAR(densities(NormalDistribution::vmf, 1e-4, {0.0}).front(), 0.0795775 * (1 + 1e-4), 1e-6);
}

// Golden: the exact NDF of four texels under exponent 100 is the mean of four lobes.
TEST(Lobes, FourTexelsMeetTheGoldenDensity) {
  const std::vector<glm::vec3> normals{{0, 0, 1}, {0.6F, 0, 0.8F}, {0, -0.6F, 0.8F}, {-0.28F, 0, 0.96F}};
  const std::vector<std::pair<glm::vec3, double>> golden{{{0, 0, 1}, 4.086458431324459},
                                                         {{0.3F, 0, 0.95F}, 0.04669912891540566},
                                                         {{0, -0.3F, 0.9F}, 0.041771970340579355}};
  for (const auto& [h, expected] : golden) {
    Inputs inputs;
    for (const glm::vec3& n : normals) inputs.push_back({glm::vec4(100), glm::vec4(n, 0), glm::vec4(h, 0)});
    double mean = 0;
    for (const glm::vec4& v : evaluate_glsl(functions_of(NormalDistribution::blinn_phong),
                                            "return vec4(lobeDensity(a.x, b.xyz, normalize(c.xyz)));", inputs))
      mean += v.x / 4;
    EXPECT_NEAR(mean / expected, 1.0, 1e-4);
  }
}

// docs/explanation/base-brdf.md, the last column of its table of widths.
float alpha_of(const Lobe& lobe) {
  const auto p = static_cast<float>(lobe.parameter);
  switch (lobe.distribution) {
    case NormalDistribution::blinn_phong:
      return std::sqrt(2.0F / (p + 2.0F));
    case NormalDistribution::vmf:
      return std::min(std::sqrt(2.0F / std::max(p, 1e-6F)), 1.0F);
    case NormalDistribution::beckmann:
    case NormalDistribution::ggx:
      break;
  }
  return p;
}

TEST(Lobes, CppTwinsAgreeWithGlsl) {
  for (const NormalDistribution distribution : {NormalDistribution::blinn_phong, NormalDistribution::vmf,
                                                NormalDistribution::beckmann, NormalDistribution::ggx}) {
    Inputs inputs;
    for (const float alpha : {0.0F, 1e-3F, 0.01F, 0.25F, 0.9F, 1.0F}) inputs.push_back({glm::vec4(alpha), {}, {}});
    const auto glsl = evaluate_glsl(functions_of(distribution),
                                    "float lobe = lobeFromAlpha(a.x);\nreturn vec4(lobe, lobeVariance(lobe), "
                                    "lobeAlpha(lobe), lobeFromVariance(lobeVariance(lobe)));",
                                    inputs);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      const Lobe lobe = lobe_from_alpha(distribution, inputs[i][0].x);
      EXPECT_NEAR(glsl[i].x, lobe.parameter, 1e-5 * std::abs(lobe.parameter));
      EXPECT_NEAR(glsl[i].y, lobe_variance(lobe), 1e-5F * lobe_variance(lobe));
      EXPECT_NEAR(glsl[i].z, alpha_of(lobe), 1e-5F);
      // A uniform lobe (exponent 0) has no finite width to come back from.
      EXPECT_TRUE(lobe.parameter <= 0.0 || std::abs(glsl[i].w - lobe.parameter) <= 1e-5 * lobe.parameter);
      EXPECT_NEAR(lobe_from_variance(distribution, lobe_variance(lobe)).parameter, glsl[i].w, 1e-5F * glsl[i].w);
    }
  }
}

// Hard cases 17 and 18: grazing and opposite directions stay finite, and Tan's term stays under its bound.
TEST(Terms, GrazingAndOppositeDirectionsAreFinite) {
  Inputs inputs;
  for (const double angle : {0.0, 1.0, 1.5, 1.5706, pi / 2}) {
    inputs.push_back({glm::vec4(direction(angle), 0), glm::vec4(direction(angle, 0.3 + pi), 0), {}});
    inputs.push_back({glm::vec4(direction(angle), 0), glm::vec4(-direction(angle), 0), {}});
  }
  for (const NormalDistribution d : {NormalDistribution::blinn_phong, NormalDistribution::vmf,
                                     NormalDistribution::beckmann, NormalDistribution::ggx}) {
    for (const GeometryTerm g : {GeometryTerm::none, GeometryTerm::tan, GeometryTerm::smith}) {
      const std::string body =
          "float lobe = lobeFromAlpha(0.3);\nvec3 n = vec3(0, 0, 1);\nvec3 s = facetSpecular(evenFacets(n, lobe), "
          "vec3(0.5), a.xyz, "
          "b.xyz);\n"
          "vec3 h = halfVector(a.xyz, b.xyz);\n"
          "float bound = 2.0 * lobeDensity(lobe, n, h) * max(h.z, 0.0) / max(dot(b.xyz, h), 1e-6);\nreturn vec4(s, "
          "bound);";
      for (const glm::vec4& v : evaluate_glsl(functions_of({d, g, FresnelTerm::schlick, true}), body, inputs)) {
        EXPECT_TRUE(std::isfinite(v.x)) << static_cast<int>(d) << " " << static_cast<int>(g);
        EXPECT_GE(v.x, 0.0F);
        EXPECT_TRUE(g != GeometryTerm::tan || v.x <= v.w * 1.0001F + 1e-6F);
      }
    }
  }
}

}  // namespace
}  // namespace footprint::testing
