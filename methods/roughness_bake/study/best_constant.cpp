// Integrates over the angle from the mean normal, about which normals are symmetric; the quantities of experiments.
#include "methods/roughness_bake/study/best_constant.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "methods/registry.hpp"
#include "methods/roughness_bake/presets.hpp"

namespace footprint::roughness_bake {
namespace {

using std::numbers::pi;

constexpr int angle_count = 160, tilt_count = 160, azimuth_count = 96;

// Equally probable angles from the normal, of slopes of a Gaussian of deviation sigma per axis.
std::vector<double> tilts_of(double sigma, int count) {
  std::vector<double> tilts;
  tilts.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) tilts.push_back(std::atan(sigma * std::sqrt(-2.0 * std::log1p(-(i + 0.5) / count))));
  return tilts;
}

double shortfall_of(double sigma) {
  constexpr int count = 20000;
  double shortfall = 0;
  for (const double tilt : tilts_of(sigma, count)) shortfall += 2.0 * std::pow(std::sin(tilt / 2), 2) / count;
  return shortfall;
}

// The mean of the lobe over normals at these tilts in all directions, at an angle from the mean normal.
double mean_density(const Lobe& lobe, std::span<const double> tilts, double angle) {
  double sum = 0;
  for (const double tilt : tilts) {
    const double least = 2.0 * std::pow(std::sin((angle - tilt) / 2), 2);  // 1 - cos at azimuth 0
    for (int i = 0; i < azimuth_count; ++i) {
      const double turn = (i + 0.5) * pi / azimuth_count;
      sum += lobe_density(lobe, least + 2.0 * std::sin(angle) * std::sin(tilt) * std::pow(std::sin(turn / 2), 2));
    }
  }
  return sum / static_cast<double>(tilts.size() * azimuth_count);
}

Lobe lobe_of_alpha2(NormalDistribution distribution, double alpha2) {
  return lobe_from_variance(distribution, static_cast<float>(0.5 * alpha2));
}

}  // namespace

WidenedLobe::WidenedLobe(NormalDistribution distribution, double alpha, double sigma)
    : distribution_(distribution), alpha_(alpha), shortfall_(shortfall_of(sigma)) {
  const std::vector<double> tilts = tilts_of(sigma, tilt_count);
  const double reach = std::min(pi / 2, 9.0 * std::hypot(alpha / std::numbers::sqrt2, sigma));
  const Lobe lobe = lobe_of_alpha2(distribution, alpha * alpha);
  for (int i = 0; i < angle_count; ++i) {
    angles_.push_back((i + 0.5) / angle_count * reach);
    exact_.push_back(mean_density(lobe, tilts, angles_.back()));
  }
}

double WidenedLobe::error(double c) const { return error_of(alpha_ * alpha_ + c * inverse_kappa(shortfall_)); }

double WidenedLobe::error_of(double alpha2) const {
  const Lobe lobe = lobe_of_alpha2(distribution_, alpha2);
  double difference = 0, norm = 0;
  for (std::size_t i = 0; i < angles_.size(); ++i) {
    const double ring = std::sin(angles_[i]);
    const double density = lobe_density(lobe, 2.0 * std::pow(std::sin(angles_[i] / 2), 2));
    difference += ring * std::pow(density - exact_[i], 2);
    norm += ring * std::pow(exact_[i], 2);
  }
  return std::sqrt(difference / norm);
}

double best_constant(NormalDistribution distribution, double alpha, std::span<const double> sigmas) {
  std::vector<WidenedLobe> lobes;
  for (const double sigma : sigmas) lobes.emplace_back(distribution, alpha, sigma);
  constexpr double step = 0.005, most = 4.0;
  double best = 0, least = std::numeric_limits<double>::infinity();
  for (int i = 0; i * step <= most; ++i) {
    double sum = 0;
    for (const WidenedLobe& lobe : lobes) sum += lobe.error(i * step);
    if (sum < least) {
      least = sum;
      best = i * step;
    }
  }
  return best;
}

}  // namespace footprint::roughness_bake

namespace footprint {
namespace {

using namespace roughness_bake;

const std::vector<OptionSpec>& surface_parameters() {
  static const std::vector<OptionSpec> parameters{
      number_option("alpha", 0.2, 0.01, 1.0, "Of the base lobe: its square is twice its slope variance per axis."),
      number_option("sigma", 0.2, 0.001, 1.0, "Deviation per axis of the texels' slopes, an even Gaussian.")};
  return parameters;
}

double measured_best(const Material& material, const Options& /*options*/, const Options& parameters) {
  const std::array<double, 1> sigma{parameters.number("sigma")};
  return best_constant(material.brdf.distribution, parameters.number("alpha"), sigma);
}

double measured_error(const Material& material, const Options& options, const Options& parameters) {
  const Formula formula = formula_of(options);
  const double alpha = parameters.number("alpha");
  const WidenedLobe lobe(material.brdf.distribution, alpha, parameters.number("sigma"));
  const double stored = stored_spread(formula.preset, lobe.shortfall());
  return lobe.error_of(widened_alpha2(formula, material.brdf.distribution, alpha * alpha, stored));
}

}  // namespace

std::span<const Quantity> roughness_bake_quantities() {
  static const std::vector<Quantity> quantities{
      {.name = "best_constant",
       .summary = "The constant c of alpha^2 + c / kappa whose lobe is closest to the true distribution of normals.",
       .parameters = surface_parameters(),
       .measure = measured_best},
      {.name = "ndf_error",
       .summary = "Relative L2 difference over solid angle of the preset's lobe from the true distribution of normals.",
       .parameters = surface_parameters(),
       .measure = measured_error}};
  return quantities;
}

}  // namespace footprint
