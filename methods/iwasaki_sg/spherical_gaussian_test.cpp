// Integrals and convolutions of spherical Gaussians: golden numbers, Figure 5 of the paper, C++ against GLSL.
#include "methods/iwasaki_sg/spherical_gaussian.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "renderer/lobes/lobe.hpp"
#include "renderer/microgeometry/direction_grid.hpp"
#include "renderer/pipeline/shader_source.hpp"
#include "tests/methods/iwasaki_materials.hpp"
#include "tests/support/shader_probe.hpp"

namespace footprint::iwasaki_sg {
namespace {

SphericalGaussian tilted(double sharpness, double degrees) {
  const double angle = degrees * std::numbers::pi / 180.0;
  return {{std::sin(angle), 0.0, std::cos(angle)}, sharpness};
}

struct GoldenConvolution {
  double eta1, eta2, degrees, exact, sg_form;
};

// By quadrature in 50 digits.
constexpr std::array<GoldenConvolution, 39> golden{{
    {1, 4, 0, 1.2565800102015912, 1.2566370614359173},
    {1, 4, 1, 1.2564575158865768, 1.2564839572346193},
    {1, 4, 10, 1.2444089979207868, 1.241456586024187},
    {1, 4, 45, 1.0382059087793195, 0.99414180545666823},
    {1, 4, 90, 0.63388592822242289, 0.56464342908631007},
    {1, 4, 180, 0.28274296310684258, 0.25371064708694757},
    {1, 10, 0, 0.57119866412971927, 0.57119866428905332},
    {1, 10, 1, 0.57112677045946048, 0.57111958219741486},
    {1, 10, 10, 0.56406776450498288, 0.56336399060911751},
    {1, 10, 45, 0.44718797738928567, 0.43767232328261194},
    {1, 10, 90, 0.24176053373458618, 0.23013041351242799},
    {1, 10, 180, 0.0944818500249625, 0.092717316293654446},
    {10, 1000, 0, 0.0062209755516629569, 0.0062209755516629569},
    {10, 1000, 1, 0.0062116108517339602, 0.0062116015845463088},
    {10, 1000, 10, 0.0053529413626364827, 0.005352204052756138},
    {10, 1000, 45, 0.00034187784032885031, 0.0003423210895688509},
    {10, 1000, 90, 2.9986620052996254e-7, 3.1182657830585065e-7},
    {10, 1000, 180, 1.3081424400349422e-11, 1.5630316198870491e-11},
    {100, 1000, 0, 0.0057119866428905332, 0.0057119866428905332},
    {100, 1000, 1, 0.0056335144967241904, 0.0056334440771394507},
    {100, 1000, 10, 0.0014359728111919723, 0.0014354143082313056},
    {100, 1000, 45, 1.1489518741625482e-14, 1.5594709884319203e-14},
    {100, 1000, 90, 3.409115337529569e-44, 1.8856915134849924e-42},
    {100, 1000, 180, 9.6614203593879233e-90, 6.2252114830399943e-82},
    {512, 512, 0, 0.0061359231515425649, 0.0061359231515425649},
    {512, 512, 1, 0.0059015075496593198, 0.005901287219005037},
    {512, 512, 10, 0.00012509822456064762, 0.00012554956111510928},
    {512, 512, 45, 9.3359130829275583e-37, 1.6756807478812174e-35},
    {512, 512, 90, 4.8265897110668055e-133, 4.0596869394513206e-114},
    {10000, 10000, 0, 0.00031415926535897932, 0.00031415926535897932},
    {10000, 10000, 1, 0.00014670143000557742, 0.00014669797095421727},
    {10000, 10000, 10, 2.7949447809769434e-37, 3.2181382711723922e-37},
    {100000, 50, 0, 6.2800452845373178e-5, 6.2800452845373178e-5},
    {100000, 50, 1, 6.2324270445066489e-5, 6.2324265721709203e-5},
    {100000, 50, 10, 2.9392344790854455e-5, 2.9392206416798904e-5},
    {100000, 50, 45, 2.7583175794940323e-11, 2.7608689849506351e-11},
    {100000, 50, 90, 1.2271125551411988e-26, 1.2419114075467995e-26},
    {100000, 50, 180, 2.338561952388782e-48, 2.4559439849779759e-48},
    {1, 1, 180, 1.70067332635, 0.0},
}};

TEST(SphericalGaussian, ConvolutionHasTheGoldenValues) {
  for (const GoldenConvolution& g : golden) {
    const SphericalGaussian a = tilted(g.eta1, 0.0), b = tilted(g.eta2, g.degrees);
    EXPECT_NEAR(convolution(a, b) / g.exact, 1.0, 1e-9) << g.eta1 << " " << g.eta2 << " " << g.degrees;
    if (g.sg_form > 0.0) {
      EXPECT_NEAR(approximate_convolution(a, b) / g.sg_form, 1.0, 1e-9) << g.degrees;
    }
    EXPECT_NEAR(convolution(a, b), convolution(b, a), 1e-12 * convolution(a, b));
  }
}

TEST(SphericalGaussian, IntegralHasTheGoldenValues) {
  constexpr std::array<std::array<double, 2>, 7> values{{{1e-6, 12.566358047996936171},
                                                         {1e-3, 12.553812617138108107},
                                                         {0.1, 11.389482689039328658},
                                                         {1, 5.43284864400431382},
                                                         {10, 0.62831852942289763206},
                                                         {512, 0.012271846303085129838},
                                                         {1e5, 0.000062831853071795864769}}};
  for (const auto& [eta, exact] : values) EXPECT_NEAR(vmf_integral(eta) / exact, 1.0, 1e-14) << eta;
  EXPECT_DOUBLE_EQ(vmf_integral(0.0), 4.0 * std::numbers::pi);
}

// The largest difference between Eq. 11 and Eq. 14 over all angles.
double largest_error(double eta1, double eta2) {
  double largest = 0.0;
  constexpr int steps = 200000;
  for (int i = 0; i <= steps; ++i) {
    const SphericalGaussian a = tilted(eta1, 0.0), b = tilted(eta2, 180.0 * i / steps);
    largest = std::max(largest, std::abs(convolution(a, b) - approximate_convolution(a, b)));
  }
  return largest;
}

// Figure 5 and its discussion: what the paper prints, to its digits, and our own numbers to more.
TEST(SphericalGaussian, ReproducesFigure5) {
  struct Panel {
    double eta1, eta2, error, printed, digit;
  };
  constexpr std::array<Panel, 7> panels{{{1, 10, 0.012946205881434969, 1.3e-2, 0.1e-2},
                                         {1, 1000, 1.4470265248698808e-06, 1.4e-6, 0.1e-6},
                                         {10, 10000, 1.4459944094912577e-08, 1.4e-8, 0.1e-8},
                                         {100, 1000, 1.1981971156410816e-06, 1.2e-6, 0.1e-6},
                                         {1, 4, 0.0702638849703957, 0.070, 0.001},
                                         {1, 6, 0.03365664843704813, 0.034, 0.001},
                                         {1, 8, 0.01971646571076069, 0.020, 0.001}}};
  for (const Panel& p : panels) {
    const double error = largest_error(p.eta1, p.eta2);
    EXPECT_NEAR(error / p.error, 1.0, 1e-5) << p.eta1 << " " << p.eta2;
    EXPECT_LE(std::abs(error - p.printed), 0.5001 * p.digit) << p.eta1 << " " << p.eta2;
  }
}

// The law behind it, for lobes that are not too wide.
TEST(SphericalGaussian, ErrorOfTheSgFormFallsWithTheSquareOfTheSharpness) {
  const double sum = 3000.0;
  EXPECT_NEAR(largest_error(1000.0, 2000.0) * sum * sum, 1.4488, 2e-3);
}

std::string functions() {
  ShaderModule module = iwasaki_sg_method().shader;
  module.text = "#include \"iwasaki_sg_lobes.glsl\"\n#include \"direction_grid.glsl\"\n";
  return shared_functions(shader_flags({}, Options(iwasaki_sg_method().info.options, {}, "test")), module);
}

// The software rasteriser's exp is good to 7e-6.
TEST(SphericalGaussian, GlslConvolvesAsCppDoes) {
  std::vector<std::array<glm::vec4, 3>> inputs;
  std::vector<glm::dvec3> expected;
  for (const double eta1 : {1.0, 7.0, 44.0, 100.0, 1e4, 1e6}) {
    for (const double eta2 : {1.0, 45.0, 1000.0, 1e5, 1e6}) {
      for (const double degrees : {0.0, 0.05, 1.0, 10.0, 60.0, 180.0}) {
        const glm::vec3 a(0.0F, 0.0F, 1.0F);
        const glm::vec3 b(tilted(1.0, degrees).axis);
        inputs.push_back(
            {glm::vec4(a, static_cast<float>(eta1)), glm::vec4(b, static_cast<float>(eta2)), glm::vec4(0)});
        const SphericalGaussian first{glm::dvec3(a), eta1}, second{glm::dvec3(b), eta2};
        expected.emplace_back(convolution(first, second), approximate_convolution(first, second), vmf_integral(eta2));
      }
    }
  }
  const auto got = testing::evaluate_glsl(functions(),
                                          "return vec4(sgConvolution(a.xyz, a.w, b.xyz, b.w), "
                                          "sgApproximateConvolution(a.xyz, a.w, b.xyz, b.w), sgIntegral(b.w), 0);",
                                          inputs);
  for (std::size_t i = 0; i < got.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      const double value = got[i][k], exact = expected[i][k];
      ASSERT_TRUE(std::isfinite(value));
      // The exponent itself has 24 bits: an argument of size x leaves an error of x 2^-23.
      const double allowed = 2e-5 + std::abs(std::log(std::max(exact, 1e-37))) * 4e-7;
      EXPECT_LE(std::abs(value - exact), allowed * exact + 1e-37) << i << " " << k;
    }
  }
}

TEST(SphericalGaussian, GlslFindsDirectionsWhereCppDoes) {
  std::vector<std::array<glm::vec4, 3>> inputs;
  std::vector<glm::dvec3> directions = direction_grid(17);
  for (const glm::dvec3& more : {glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0), glm::dvec3(0, -1, 0),
                                 glm::dvec3(-0.6, 0.0, -0.8), glm::dvec3(0, 0, -1)}) {
    directions.push_back(more);
  }
  for (const glm::dvec3& d : directions) inputs.push_back({glm::vec4(glm::vec3(d), 0), glm::vec4(0), glm::vec4(0)});
  const auto got = testing::evaluate_glsl(functions(), "return vec4(hemisphereToSquare(a.xyz), 0, 0);", inputs);
  for (std::size_t i = 0; i < got.size(); ++i) {
    const glm::dvec2 expected = hemisphere_to_square(glm::dvec3(glm::vec3(directions[i])));
    EXPECT_NEAR(got[i].x, expected.x, 2e-5);
    EXPECT_NEAR(got[i].y, expected.y, 2e-5);
  }
}

}  // namespace
}  // namespace footprint::iwasaki_sg
