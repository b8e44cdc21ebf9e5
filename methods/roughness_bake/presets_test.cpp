// Every preset against its formula as its source has it, written out once more without a stable form; the limits.
#include "methods/roughness_bake/presets.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <vector>

#include "methods/roughness_bake/roughness_bake.hpp"

namespace footprint::roughness_bake {
namespace {

constexpr NormalDistribution ggx = NormalDistribution::ggx;
const std::vector<double> lengths{0.3, 0.7, 0.9, 0.97, 0.995, 0.9995, 1 - 1.3e-5, 0.99999, 1.0};
const std::vector<double> alphas{0.02, 0.1, 0.3, 0.6, 0.69};

double kappa_of(double r) { return (3 * r - r * r * r) / (1 - r * r); }

// solveVMF of roughness-prefilter: 10000 is only for lengths that no kappa fits.
double filament_kappa(double r) { return r < 1 ? kappa_of(r) : 1e4; }

// The mean cosine of GGX's normals, each by its share of the surface's area: an integral over tan^2.
double ggx_mean_length(double alpha) {
  double sum = 0, mass = 0;
  constexpr int steps = 200000;
  for (int i = 0; i < steps; ++i) {
    const double x = -25 + 50.0 * (i + 0.5) / steps;  // ln of tan^2
    const double t2 = std::exp(x), c2 = 1 / (1 + t2);
    const double d = alpha * alpha / (std::numbers::pi * std::pow(c2 * (alpha * alpha + t2), 2));
    const double weight = d * c2 * c2 * t2;  // D cos dw with dw = cos^3 tan dtan ..., by d(tan^2) = tan^2 dx
    sum += weight * std::sqrt(c2);
    mass += weight;
  }
  return sum / mass;
}

// A formula as its source prints it: alpha^2 and the mean normal's length in, alpha'^2 out.
using Printed = std::function<double(double alpha2, double r)>;
const std::map<Preset, Printed>& printed_formulas() {
  static const std::map<Preset, Printed> formulas{
      {Preset::filament, [](double a2, double r) { return a2 + 2 / filament_kappa(r); }},
      {Preset::filament_rho,
       [](double a2, double r) {
         const double rho = std::pow(a2, 0.25);
         return std::pow(rho * rho + 2 / filament_kappa(r), 2);
       }},
      {Preset::unity, [](double a2, double r) { return a2 + std::min(2 * 0.25 / kappa_of(r), 0.2 * 0.2); }},
      {Preset::unity_projected,
       [](double a2, double r) {
         const double p = std::min(a2 / (1 - a2) + std::min(2 * 0.25 / kappa_of(r), 0.2 * 0.2), 1.0);
         return p / (1 + p);
       }},
      {Preset::hdrp_import, [](double a2, double r) { return a2 + 2 * std::min(0.25 / kappa_of(r), 0.03125); }},
      {Preset::unreal,
       [](double a2, double r) {
         const double v = std::max(0.0, (1 - r) / r - 0.00004);
         return (a2 + 2 * v * (1 - a2)) / (1 + 2 * v * (1 - a2));
       }},
      {Preset::godot,
       [](double a2, double r) {
         const double rho2 = std::sqrt(a2);
         return std::pow(rho2 + std::min(0.75 / kappa_of(r), 0.16), 2);
       }},
      {Preset::three_removed, [](double a2, double r) { return a2 + 0.56 * (1 - r); }},
      {Preset::mjp_vmf, [](double a2, double r) { return a2 + 2 / kappa_of(r); }},
      {Preset::karis,
       [](double a2, double r) {
         const double k = 2 / a2;
         const double both = r * (1 / std::tanh(k) - 1 / k);
         return 2 * (1 - both * both) / (both * (3 - both * both));
       }},
      {Preset::order1886, [](double a2, double r) { return a2 + 1 / kappa_of(r); }}};
  return formulas;
}

double widened(Preset preset, double alpha2, double r) {
  return widened_alpha2({.preset = preset}, ggx, alpha2, stored_spread(preset, 1 - r));
}

TEST(RoughnessPresets, AreTheFormulasAsPrinted) {
  for (const auto& [preset, printed] : printed_formulas()) {
    for (const double alpha : alphas) {
      for (const double r : lengths) {
        const double expected = printed(alpha * alpha, r);
        EXPECT_NEAR(widened(preset, alpha * alpha, r) / expected, 1.0, 1e-9)
            << preset_names[static_cast<std::size_t>(preset)] << ", alpha " << alpha << ", r " << r;
      }
    }
  }
}

// Filament copies the roughness to the finest level (main.cpp, i == 0), and prefilters the others.
TEST(RoughnessPresets, FilamentWidensFlatTexelsOfEveryLevelButTheFinest) {
  Image flat(4, 4, 4, 0.0F);
  for (std::size_t i = 2; i < flat.texels.size(); i += 4) flat.texels[i] = flat.texels[i + 1] = 1.0F;
  const std::vector<Image> chain = spread_chain(flat, Preset::filament);
  ASSERT_EQ(chain.size(), 3U);
  EXPECT_EQ(chain[0].texels.front(), 0.0F);
  EXPECT_FLOAT_EQ(chain[1].texels.front(), 1e-4F);
  EXPECT_FLOAT_EQ(chain[2].texels.front(), 1e-4F);
}

TEST(RoughnessPresets, ChanWidensTheLobeToTheMeanLengthOfBoth) {
  for (const double alpha : {0.02, 0.1, 0.4, 0.8}) {
    for (const double r : {0.75, 0.9, 0.99, 0.9999}) {
      const double wanted = r * ggx_mean_length(alpha);
      const double found = std::sqrt(widened(Preset::chan2018, alpha * alpha, r));
      if (found < 0.9999)
        EXPECT_NEAR(ggx_mean_length(found), wanted, 2e-6) << alpha << " " << r;
      else
        EXPECT_LT(wanted, 2.0 / 3.0 + 1e-4);
    }
  }
}

TEST(RoughnessPresets, GgxsMeanLengthIsItsIntegral) {
  for (const double alpha : {0.001, 0.03, 0.3, 0.9, 0.994, 0.996, 0.99999}) {
    EXPECT_NEAR((1 - ggx_shortfall(alpha * alpha)) / ggx_mean_length(alpha), 1.0, 1e-7) << alpha;
  }
  EXPECT_NEAR(ggx_shortfall(1.0), 1.0 / 3.0, 1e-12);
}

TEST(RoughnessPresets, LeaveTheLobeWhereNormalsAgree) {
  for (std::size_t i = 0; i < preset_names.size(); ++i) {
    const auto preset = static_cast<Preset>(i);
    // What the sources themselves do to a flat map: README.
    const double allowed = preset == Preset::filament       ? 2.0001e-4
                           : preset == Preset::filament_rho ? 4e-4
                           : preset == Preset::karis        ? 0.022
                           : preset == Preset::chan2018     ? 1e-5
                                                            : 1e-12;
    for (const double alpha : alphas)
      EXPECT_NEAR(widened(preset, alpha * alpha, 1.0), alpha * alpha, allowed) << preset_names[i] << " " << alpha;
  }
}

TEST(RoughnessPresets, WidenMoreWhereNormalsAgreeLess) {
  for (std::size_t i = 0; i < preset_names.size(); ++i) {
    for (const double alpha : alphas) {
      double before = 0;
      for (double r = 1.0; r > 0.02; r -= 0.01) {
        const double now = widened(static_cast<Preset>(i), alpha * alpha, r);
        ASSERT_TRUE(std::isfinite(now));
        EXPECT_GE(now, before * (1 - 1e-12)) << preset_names[i] << ", r " << r;
        before = now;
      }
    }
  }
}

TEST(RoughnessPresets, FreeTakesItsOwnConstantAndCap) {
  const double stored = stored_spread(Preset::free, 0.1);
  const Formula formula{.preset = Preset::free, .constant = 1.5, .cap = 0.05};
  EXPECT_NEAR(widened_alpha2(formula, ggx, 0.04, 0.01), 0.055, 1e-12);
  EXPECT_NEAR(widened_alpha2(formula, ggx, 0.04, stored), 0.09, 1e-12);
}

// Engines' behaviour beyond the published numbers: a map whose normals cancel stays finite.
TEST(RoughnessPresets, StayFiniteWhereNormalsCancel) {
  for (std::size_t i = 0; i < preset_names.size(); ++i)
    EXPECT_TRUE(std::isfinite(widened(static_cast<Preset>(i), 0.01, 0.0))) << preset_names[i];
}

TEST(RoughnessPresets, AreKnownByTheirNames) {
  EXPECT_EQ(preset_of("godot"), Preset::godot);
  EXPECT_EQ(preset_of("free"), Preset::free);
  EXPECT_THROW((void)preset_of("blender"), std::out_of_range);
}

}  // namespace
}  // namespace footprint::roughness_bake
