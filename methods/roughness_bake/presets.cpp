// The formulas, each with its source in README.md, and their stable forms.
#include "methods/roughness_bake/presets.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "renderer/core/error.hpp"
#include "renderer/lobes/lobe.hpp"

namespace footprint::roughness_bake {
namespace {

constexpr double filament_flat = 1e-4;      // kappa = 1e4, only where all normals agree
constexpr double unity_cap = 0.2 * 0.2;     // of variance, the default threshold squared
constexpr double hdrp_cap = 2.0 * 0.03125;  // twice the largest variance that its texture stores
constexpr double unreal_offset = 4e-5;
constexpr double godot_cap = 0.16;
constexpr double three_factor = 0.56;
constexpr double least_chan_alpha2 = 2.0 / (1.0 + 262144.0);  // gloss 1: 2 / (1 + 2^18)

double squared(double x) { return x * x; }

double fit_constant(NormalDistribution distribution, double alpha) {
  const FitTable& table = fit_table(distribution);
  const double at = std::clamp(alpha, 0.0, 1.0) * (fit_points - 1);
  const auto i = std::min(static_cast<std::size_t>(at), fit_points - 2);
  return std::lerp(table[i], table[i + 1], at - static_cast<double>(i));
}

// Adds to p = alpha^2 / (1 - alpha^2), a slope variance of the lobe projected on the disc (Tokuyoshi and Kaplanyan
// 2021). The form alpha'^2 - alpha^2 = (1 - alpha^2)^2 d / (1 + (1 - alpha^2) d) has no quotient that grows. The sum
// saturates at p' = 1, which is alpha^2 = 1/2, so wider lobes become narrower.
double projected(double alpha2, double d) {
  if (alpha2 >= 0.5) return 0.5;
  const double rest = 1.0 - alpha2;
  return std::min(alpha2 + rest * rest * d / (1.0 + rest * d), 0.5);
}

double unreal(double alpha2, double v) {
  const double added = 2.0 * std::max(v - unreal_offset, 0.0);
  const double rest = std::max(1.0 - alpha2, 0.0);
  return (alpha2 + added * rest) / (1.0 + added * rest);
}

// 1 minus the product of two mean lengths, the lobe's and the normals', each given by 1 minus the length.
double joined(double a, double b) { return a + b - a * b; }

double karis(double alpha2, double q) {
  const double kappa = 2.0 / alpha2;
  const double own = 1.0 - vmf_mean(kappa).by_kappa * kappa;
  return 2.0 * inverse_kappa(std::min(joined(own, q), 1.0 - 1e-6));
}

double chan(double alpha2, double q) {
  const double wanted = joined(ggx_shortfall(std::clamp(alpha2, least_chan_alpha2, 1.0)), q);
  double low = std::sqrt(least_chan_alpha2), high = 1.0;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (ggx_shortfall(middle * middle) < wanted ? low : high) = middle;
  }
  return squared(0.5 * (low + high));
}

enum class Stored { inverse_kappa, toksvig, shortfall };
constexpr double largest_stored = 100;

// What a texel stores, and alpha'^2 of alpha^2 over it.
struct Rule {
  Stored stored = Stored::inverse_kappa;
  double (*widened)(double alpha2, double stored) = nullptr;
};

const Rule& rule_of(Preset preset) {
  using enum Stored;
  static constexpr std::array<Rule, preset_names.size()> rules{
      {{},  // fit: by distribution
       {inverse_kappa, [](double alpha2, double v) { return alpha2 + 2.0 * v; }},
       {inverse_kappa,
        [](double alpha2, double v) { return squared(std::sqrt(alpha2) + 2.0 * v); }},  // on rho^2 = alpha
       {inverse_kappa, [](double alpha2, double v) { return alpha2 + std::min(0.5 * v, unity_cap); }},
       {inverse_kappa, [](double alpha2, double v) { return projected(alpha2, std::min(0.5 * v, unity_cap)); }},
       {inverse_kappa, [](double alpha2, double v) { return alpha2 + std::min(0.5 * v, hdrp_cap); }},
       {toksvig, unreal},
       {inverse_kappa,  // on rho^2 = alpha
        [](double alpha2, double v) { return squared(std::sqrt(alpha2) + std::min(0.75 * v, godot_cap)); }},
       {shortfall, [](double alpha2, double v) { return alpha2 + three_factor * v; }},
       {inverse_kappa, [](double alpha2, double v) { return alpha2 + 2.0 * v; }},
       {shortfall, karis},
       {inverse_kappa, [](double alpha2, double v) { return alpha2 + v; }},
       {shortfall, chan},
       {}}};  // free: by its parameters
  return rules.at(static_cast<std::size_t>(preset));
}

}  // namespace

Preset preset_of(std::string_view name) {
  const auto* const found = std::ranges::find(preset_names, name);
  if (found == preset_names.end()) throw std::out_of_range("no preset " + std::string(name));
  return static_cast<Preset>(found - preset_names.begin());
}

Formula formula_of(const Options& options) {
  const std::string& preset = options.word("preset");
  const Formula formula{
      .preset = preset_of(preset), .constant = options.number("constant"), .cap = options.number("cap")};
  if (formula.preset != Preset::free && (formula.constant != Formula{}.constant || formula.cap != Formula{}.cap)) {
    throw Error(ErrorKind::usage, "roughness_bake", "preset=" + preset + " has its own constant and cap",
                "give preset=free for others, or leave `constant` and `cap` out");
  }
  return formula;
}

double inverse_kappa(double q) {
  const double r = 1.0 - q;
  return r > 0.0 ? q * (2.0 - q) / (r * (3.0 - r * r)) : std::numeric_limits<double>::infinity();
}

// The series is 2 / ((2 k - 1) (2 k + 1)) a^(2 k - 2) from k = 1 on: 2/3 at a = 0, where the closed form is 0 / 0.
double ggx_shortfall(double alpha2) {
  const double a2 = std::max(1.0 - alpha2, 0.0);
  if (a2 < 0.01) return 1.0 / 3.0 - a2 * (2.0 / 15.0 + a2 * (2.0 / 35.0 + a2 * 2.0 / 63.0));
  const double a = std::sqrt(a2);
  // 1 - r = (a^3 - a + alpha^2 atanh a) / a^3 = alpha^2 (atanh(a) - a) / a^3; atanh a = ln((1 + a) / alpha).
  return alpha2 * (std::log((1.0 + a) / std::sqrt(alpha2)) - a) / (a2 * a);
}

double stored_spread(Preset preset, double shortfall) {
  const double q = std::clamp(shortfall, 0.0, 1.0);
  switch (rule_of(preset).stored) {
    case Stored::toksvig:
      return std::min(q / std::max(1.0 - q, 1e-12), largest_stored);
    case Stored::shortfall:
      return q;
    case Stored::inverse_kappa:
      break;
  }
  if (q == 0.0 && (preset == Preset::filament || preset == Preset::filament_rho)) return filament_flat;
  return std::min(inverse_kappa(q), largest_stored);
}

double widened_alpha2(const Formula& formula, NormalDistribution distribution, double alpha2, double stored) {
  if (formula.preset == Preset::fit) return alpha2 + fit_constant(distribution, std::sqrt(alpha2)) * stored;
  if (formula.preset == Preset::free) return alpha2 + std::min(formula.constant * stored, formula.cap);
  return rule_of(formula.preset).widened(alpha2, stored);
}

const FitTable& fit_table(NormalDistribution distribution) {
  static constexpr std::array<FitTable, 4> tables{
      // in the order of NormalDistribution
      {{2.200, 2.300, 2.335, 2.510, 2.825, 2.940, 3.120, 3.355, 3.635, 3.950, 4.000},
       {2.155, 2.215, 2.225, 2.165, 2.020, 1.795, 1.470, 1.030, 0.450, 0.000, 0.000},
       {2.015, 2.245, 2.330, 2.250, 2.010, 1.615, 1.085, 0.410, 0.000, 0.000, 0.000},
       {2.080, 2.135, 2.135, 2.115, 2.085, 2.050, 2.020, 1.995, 2.000, 2.040, 2.125}}};
  return tables.at(static_cast<std::size_t>(distribution));
}

}  // namespace footprint::roughness_bake
