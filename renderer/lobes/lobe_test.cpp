// Lobes: closed forms, the horizon, and the words that name them.
#include "renderer/lobes/lobe.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "renderer/core/error.hpp"

namespace footprint {
namespace {

using enum NormalDistribution;
using std::numbers::pi;

const std::vector<Lobe> lobes{{blinn_phong, 1}, {blinn_phong, 64}, {blinn_phong, 1e5}, {vmf, 0.5},
                              {vmf, 512},       {vmf, 1e6},        {beckmann, 0.05},   {beckmann, 0.9},
                              {ggx, 0.001},     {ggx, 0.3},        {ggx, 1.0}};

// The formulas of docs/explanation/base-brdf.md as printed, in long double: no stable form is needed there.
long double printed(const Lobe& lobe, long double theta) {
  const long double p = lobe.parameter;
  const long double c = std::cos(theta);
  const long double t = std::tan(theta);
  const long double s = std::sin(theta);
  switch (lobe.distribution) {
    case blinn_phong:
      return (p + 1) / (2 * std::numbers::pi_v<long double>)*std::pow(c, p);
    case vmf:
      return p / (2 * std::numbers::pi_v<long double> * (1 - std::exp(-2 * p))) * std::exp(p * (c - 1));
    case beckmann:
      return std::exp(-t * t / (p * p)) / (std::numbers::pi_v<long double> * p * p * c * c * c * c);
    case ggx:
      break;
  }
  const long double d = p * p * c * c + s * s;
  return p * p / (std::numbers::pi_v<long double> * d * d);
}

TEST(Lobe, IsTheFormulaAsPrinted) {
  for (const Lobe& lobe : lobes) {
    for (const double widths : {0.0, 0.3, 1.0, 3.0}) {
      const double theta = std::min(widths * lobe_width(lobe), 1.5);
      const double u = 2.0 * std::pow(std::sin(0.5 * theta), 2);
      const auto expected = static_cast<double>(printed(lobe, theta));
      EXPECT_NEAR(lobe_peak(lobe) * lobe_shape(lobe, u), expected, 1e-11 * expected) << lobe_text(lobe) << " " << theta;
    }
  }
}

TEST(Lobe, IsBelowTheCutoffBeyondItsSupport) {
  for (const Lobe& lobe : lobes) {
    const double support = lobe_support(lobe);
    EXPECT_LE(support, 2.0);
    if (support < 0.9) {
      EXPECT_NEAR(lobe_shape(lobe, support) / lobe_cutoff, 1.0, 1e-6) << lobe_text(lobe);
    }
    for (double u = support * 1.000001; u <= 2.0; u *= 1.1) EXPECT_LE(lobe_shape(lobe, u), lobe_cutoff);
  }
}

// Closed forms of the integral over the hemisphere about the surface's own normal.
TEST(Lobe, HasTheEnergyOfItsClosedForm) {
  for (const double s : {1.0, 64.0, 1e5}) EXPECT_NEAR(lobe_energy({blinn_phong, s}, 1.0), 1.0, 1e-4);
  for (const double k : {0.5, 64.0, 1e6}) {
    EXPECT_NEAR(lobe_energy({vmf, k}, 1.0), std::expm1(-k) / std::expm1(-2.0 * k), 5e-4);
  }
  for (const double a : {0.01, 0.3, 0.9}) {  // int a^2 / (a^2 + (1 - a^2)(1 - c^2))^2 2 dc over c in [0, 1]
    const double b = 1.0 - a * a;
    const double closed = 1.0 + a * a / std::sqrt(b) * std::atanh(std::sqrt(b));
    EXPECT_NEAR(lobe_energy({ggx, a}, 1.0), closed, 2e-4 * closed) << a;
  }
}

TEST(Lobe, LosesThePartBelowTheHorizon) {
  for (const Lobe& lobe : lobes) {
    if (lobe.distribution == vmf && lobe.parameter < 1.0) continue;  // also shines on the far side
    EXPECT_NEAR(lobe_energy(lobe, 0.0), 0.5 * lobe_energy(lobe, 1.0), 1e-3) << lobe_text(lobe);
    EXPECT_LE(lobe_energy(lobe, 0.3), lobe_energy(lobe, 0.6) + 1e-9);
  }
}

TEST(LobeProfile, IsTheLobesShape) {
  for (const Lobe& lobe : lobes) {
    const LobeProfile profile(lobe);
    for (double u = 0.0; u < 2.0; u += 0.37 * lobe_support(lobe) / 1024.0) {
      ASSERT_NEAR(profile(u), lobe_shape(lobe, u), 2e-9) << lobe_text(lobe) << " " << u;
      if (u > 1.5 * lobe_support(lobe)) break;
    }
  }
}

TEST(Lobe, IsReadAsItIsWritten) {
  for (const char* text : {"blinn_phong:64", "beckmann:0.2", "ggx:0.001", "vmf:1000000"}) {
    EXPECT_EQ(lobe_text(parse_lobe("--lobe", text)).substr(0, 3), std::string(text).substr(0, 3));
  }
  EXPECT_EQ(parse_lobe("--lobe", "ggx:0.25"), (Lobe{ggx, 0.25}));
}

TEST(Lobe, RefusesWhatNamesNone) {
  for (const char* text :
       {"", ":", "phong:64", "blinn_phong", "blinn_phong:", "blinn_phong:64x", "blinn_phong:nan", "blinn_phong:-1",
        "blinn_phong:inf", "beckmann:0", "ggx:2", "ggx:0.0009", "beckmann:0.0001", "vmf:1e7", "ggx:0.1:0.2"}) {
    try {
      (void)parse_lobe("--lobe", text);
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::usage);
      EXPECT_EQ(error.place(), "--lobe");
      EXPECT_FALSE(error.hint().empty());
    }
  }
}

// What a map of lobe parameters keeps of them: it is stored as roughness.
TEST(Lobe, RoughnessKeepsTheLobeParameter) {
  const auto round_trip = [](NormalDistribution distribution, float parameter) {
    const float r = lobe_roughness({distribution, parameter});
    return lobe_from_alpha(distribution, r * r).parameter;
  };
  for (float lobe = 1e-3F; lobe <= 1e6F; lobe *= 1.37F) {
    EXPECT_NEAR(round_trip(vmf, lobe), lobe, 1e-6F * lobe);
    EXPECT_NEAR(round_trip(blinn_phong, lobe), lobe, 1e-6F * std::max(lobe, 1.0F));
  }
  for (float alpha = 1e-3F; alpha <= 1.0F; alpha *= 1.37F) {
    EXPECT_NEAR(round_trip(ggx, alpha), alpha, 1e-6F * alpha);
    EXPECT_NEAR(round_trip(beckmann, alpha), alpha, 1e-6F * alpha);
  }
}

}  // namespace
}  // namespace footprint
