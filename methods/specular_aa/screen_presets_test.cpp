// Every preset against its formula as its source prints it; the limits.
#include "tests/methods/screen_presets.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <vector>

namespace footprint::specular_aa {
namespace {

using std::numbers::pi;

const std::vector<double> alphas{0.003, 0.05, 0.3, 0.7, 0.99};

// From nothing to more than a lobe can represent, in directions of all signs.
std::vector<NormalSteps> many_steps() {
  std::vector<NormalSteps> steps;
  for (const double size : {0.0, 1e-3, 0.03, 0.2, 0.6, 1.3})
    steps.push_back({size * glm::dvec3(0.6, -0.3, 0.1), size * glm::dvec3(-0.1, 0.8, -0.55)});
  return steps;
}

double sat(double x) { return std::clamp(x, 0.0, 1.0); }

// A formula as its source prints it: perceptual roughness in, alpha out.
using Printed = std::function<double(double rho, const glm::dvec3& du, const glm::dvec3& dv)>;

double tokuyoshi(double alpha, double variance, double cap) {
  return std::sqrt(sat(alpha * alpha + std::min(2 * variance, cap)));
}
double both(const glm::dvec3& du, const glm::dvec3& dv) { return dot(du, du) + dot(dv, dv); }

const std::map<Preset, Printed>& printed_formulas() {
  using V = const glm::dvec3&;
  static const std::map<Preset, Printed> formulas{
      {Preset::filament, [](double rho, V du, V dv) { return tokuyoshi(rho * rho, 0.15 * both(du, dv), 0.2 * 0.2); }},
      {Preset::unity, [](double rho, V du, V dv) { return tokuyoshi(rho * rho, 0.1 * both(du, dv), 0.2 * 0.2); }},
      {Preset::o3de, [](double rho, V du, V dv) { return tokuyoshi(rho * rho, 0.25 * both(du, dv), 0.18); }},
      {Preset::godot, [](double rho, V du, V dv) { return std::pow(tokuyoshi(rho, 0.25 * both(du, dv), 0.18), 2); }},
      {Preset::bevy, [](double rho, V du,
                        V dv) { return std::sqrt(sat(std::pow(rho, 4) + std::min(0.5 * 0.5 * both(du, dv), 0.18))); }},
      {Preset::unreal,
       [](double rho, V du, V dv) {
         return std::pow(std::max(rho, sat(std::pow(std::max(dot(du, du), dot(dv, dv)), 0.333) * 1 + 0)), 2);
       }},
      {Preset::three,
       [](double rho, V du, V dv) {
         const glm::dvec3 dxy = glm::max(glm::abs(du), glm::abs(dv));
         return std::pow(std::min(std::max(rho, 0.0525) + std::max({dxy.x, dxy.y, dxy.z}), 1.0), 2);
       }},
      {Preset::babylon, [](double rho, V du, V dv) {
         const double factor = std::pow(sat(std::max(dot(du, du), dot(dv, dv))), 0.333);
         return std::min(std::pow(std::max(rho, factor), 2) + 0.0005, 1.0);
       }}};
  return formulas;
}

TEST(ScreenPresets, AreTheFormulasAsPrinted) {
  for (const auto& [preset, printed] : printed_formulas()) {
    for (const double alpha : alphas) {
      for (const NormalSteps& steps : many_steps()) {
        const double expected = std::pow(printed(std::sqrt(alpha), steps.dx, steps.dy), 2);
        EXPECT_NEAR(widened_alpha2({.preset = preset}, alpha * alpha, steps) / expected, 1.0, 1e-9)
            << preset_names.at(static_cast<std::size_t>(preset)) << ", alpha " << alpha;
      }
    }
  }
}

TEST(ScreenPresets, BabylonWidensMoreForAnEnvironment) {
  const NormalSteps steps{{0.02, 0, 0}, {0, 0.01, 0}};
  EXPECT_NEAR(std::sqrt(widened_alpha2({.preset = Preset::babylon}, 0.09, steps, LightKind::environment)),
              0.3 + 0.0005 + 0.75 * 0.02, 1e-12);
}

TEST(ScreenPresets, FreeTakesItsOwnConstantAndCap) {
  const NormalSteps steps{{0.1, 0, 0}, {0, 0.2, 0}};
  EXPECT_NEAR(widened_alpha2({Preset::free, 0.7, 1.0}, 0.01, steps), 0.01 + 0.7 * 0.05, 1e-12);
  EXPECT_NEAR(widened_alpha2({Preset::free, 0.7, 0.02}, 0.01, steps), 0.03, 1e-12);
  EXPECT_EQ(widened_alpha2({.preset = Preset::free}, 0.01, steps),
            widened_alpha2({.preset = Preset::filament}, 0.01, steps));
}

TEST(ScreenPresets, NarrowNoLobe) {
  for (std::size_t i = 0; i < preset_names.size(); ++i) {
    if (takes_half_vectors(static_cast<Preset>(i))) continue;
    for (const double alpha2 : {1e-5, 0.1, 1.0, 3.0}) {
      for (const NormalSteps& steps : many_steps())
        EXPECT_GE(widened_alpha2({.preset = static_cast<Preset>(i)}, alpha2, steps), alpha2 * (1 - 1e-12))
            << preset_names.at(i);
    }
  }
}

// Tokuyoshi and Kaplanyan 2021, listing 1, which divides by determinants: [m / max(det m, 1)] of m = P' / det P' + 1.
glm::dmat2 listing_1(double alpha2, const glm::dvec2& du, const glm::dvec2& dv) {
  const glm::dmat2 delta = glm::transpose(glm::dmat2(du, dv));
  const glm::dmat2 filtered = glm::dmat2(alpha2 / (1 - alpha2)) + 2.0 / (2 * pi) * (glm::transpose(delta) * delta);
  const glm::dmat2 m = filtered / glm::determinant(filtered) + glm::dmat2(1.0);
  return m / std::max(glm::determinant(m), 1.0);
}

TEST(ScreenPresets, HalfVectorsOf2021AreListing1) {
  const glm::dvec3 h = glm::normalize(glm::dvec3(0.2, -0.1, 1));
  for (const double alpha2 : {1e-4, 0.04, 0.6}) {
    for (const double size : {1e-3, 0.1, 0.5}) {
      const glm::dvec2 du = size * glm::dvec2(0.9, 0.2), dv = size * glm::dvec2(-0.3, 0.4);
      const glm::dmat2 expected = listing_1(alpha2, du, dv);
      const glm::dmat2 found =
          widened_matrix(Preset::tokuyoshi_kaplanyan_2021, alpha2, h, h + glm::dvec3(du, 0), h + glm::dvec3(dv, 0));
      for (int c = 0; c < 2; ++c)
        for (int r = 0; r < 2; ++r) EXPECT_NEAR(found[c][r], expected[c][r], 1e-9 * (1 + expected[c][c])) << alpha2;
    }
  }
}

TEST(ScreenPresets, HalfVectorsOf2019SpreadInSlopes) {
  const auto at = [](double x, double y) { return glm::normalize(glm::dvec3(x, y, 1)); };
  const glm::dmat2 found =
      widened_matrix(Preset::tokuyoshi_kaplanyan_2019, 0.01, at(0.3, 0.1), at(0.5, 0.1), at(0.3, 0.2));
  EXPECT_NEAR(found[0][0], 0.01 + 0.04 / pi, 1e-12);
  EXPECT_NEAR(found[1][1], 0.01 + 0.01 / pi, 1e-12);
  EXPECT_NEAR(found[0][1], 0, 1e-12);
}

// A microfacet density times the cosine integrates to one, for any matrix.
TEST(ScreenPresets, MatrixDensitiesAreNormalised) {
  const glm::dmat2 alpha2(0.2, 0.05, 0.05, 0.06);
  for (const NormalDistribution distribution : {NormalDistribution::ggx, NormalDistribution::beckmann}) {
    double sum = 0;
    constexpr int rings = 1500, spokes = 256;
    for (int i = 0; i < rings; ++i) {
      const double x = (i + 0.5) / rings, theta = pi / 2 * x;
      for (int j = 0; j < spokes; ++j) {
        const double phi = 2 * pi * (j + 0.5) / spokes;
        const glm::dvec3 h(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
        sum += matrix_density(distribution, alpha2, h) * h.z * std::sin(theta) * (pi / 2 / rings) * (2 * pi / spokes);
      }
    }
    EXPECT_NEAR(sum, 1.0, 1e-3);
  }
}

TEST(ScreenPresets, AreKnownByTheirNames) {
  EXPECT_EQ(preset_of("bevy"), Preset::bevy);
  EXPECT_EQ(preset_of("free"), Preset::free);
  EXPECT_THROW((void)preset_of("lumberyard"), std::out_of_range);
  EXPECT_THROW((void)widened_alpha2({.preset = preset_of("tokuyoshi_kaplanyan_2019")}, 0.1, {}), std::invalid_argument);
}

}  // namespace
}  // namespace footprint::specular_aa
