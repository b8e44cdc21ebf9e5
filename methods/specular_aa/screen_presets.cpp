// The formulas, each with its source in README.md.
#include "methods/specular_aa/screen_presets.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace footprint::specular_aa {
namespace {

using std::numbers::pi;

constexpr double gaussian_pixel = 1.0 / (2.0 * pi);  // variance of the pixel filter of Tokuyoshi and Kaplanyan
constexpr double least_three_rho = 0.0525;           // the narrowest lobe of any surface
constexpr double babylon_variance = 5e-4;
constexpr double curvature_exponent = 0.333;

double squared(double x) { return x * x; }
double longest_squared(const NormalSteps& s) { return std::max(glm::dot(s.dx, s.dx), glm::dot(s.dy, s.dy)); }
double sum_squared(const NormalSteps& s) { return glm::dot(s.dx, s.dx) + glm::dot(s.dy, s.dy); }

// Lobes above 1 are unchanged (Blinn-Phong's and vMF's have no such limit).
double saturated(double value, double before) { return std::min(value, std::max(before, 1.0)); }

double added(double alpha2, double constant, double cap, const NormalSteps& steps) {
  return saturated(alpha2 + std::min(constant * sum_squared(steps), cap), alpha2);
}

// In perceptual roughness rho = sqrt(alpha).
double curvature_roughness(double rho, const NormalSteps& steps) {
  return std::max(rho, std::min(std::pow(longest_squared(steps), curvature_exponent), 1.0));
}

double three(double rho, const NormalSteps& steps) {
  double largest = 0;
  for (int i = 0; i < 3; ++i) largest = std::max({largest, std::abs(steps.dx[i]), std::abs(steps.dy[i])});
  const double least = std::max(rho, least_three_rho);
  return saturated(least + largest, least);
}

double babylon(double alpha, const NormalSteps& steps, LightKind light) {
  if (light == LightKind::environment) return alpha + babylon_variance + 0.75 * std::sqrt(longest_squared(steps));
  return squared(curvature_roughness(std::sqrt(alpha), steps)) + babylon_variance;
}

// Twice the covariance of a value over a Gaussian pixel, from its changes to neighbouring pixels.
glm::dmat2 kernel(const glm::dvec2& dx, const glm::dvec2& dy) {
  return 2.0 * gaussian_pixel * (glm::outerProduct(dx, dx) + glm::outerProduct(dy, dy));
}

glm::dvec2 slope(const glm::dvec3& h) { return glm::dvec2(h) / std::abs(h.z); }

// (P'^-1 + 1)^-1 of P' = P + K, P = alpha^2 / (1 - alpha^2), in a form without a quotient that grows.
glm::dmat2 projected(double alpha2, const glm::dmat2& kernel) {
  const glm::dmat2 scaled = std::max(1.0 - alpha2, 0.0) * kernel;
  return (glm::dmat2(alpha2) + scaled) * glm::inverse(glm::dmat2(1.0) + scaled);
}

}  // namespace

Preset preset_of(std::string_view name) {
  const auto* const found = std::ranges::find(preset_names, name);
  if (found == preset_names.end()) throw std::out_of_range("no preset " + std::string(name));
  return static_cast<Preset>(found - preset_names.begin());
}

bool takes_half_vectors(Preset preset) {
  return preset == Preset::tokuyoshi_kaplanyan_2019 || preset == Preset::tokuyoshi_kaplanyan_2021;
}

double widened_alpha2(const Formula& formula, double alpha2, const NormalSteps& steps, LightKind light) {
  const double alpha = std::sqrt(alpha2), rho = std::sqrt(alpha);
  switch (formula.preset) {
    case Preset::filament:
      return added(alpha2, 2 * 0.15, 0.2 * 0.2, steps);
    case Preset::unity:
      return added(alpha2, 2 * 0.1, 0.2 * 0.2, steps);
    case Preset::o3de:
      return added(alpha2, 2 * 0.25, 0.18, steps);
    case Preset::godot:  // on rho^2 = alpha
      return squared(saturated(alpha + std::min(2 * 0.25 * sum_squared(steps), 0.18), alpha));
    case Preset::bevy:
      return added(alpha2, 0.5 * 0.5, 0.18, steps);
    case Preset::unreal:
      return std::pow(curvature_roughness(rho, steps), 4);
    case Preset::three:
      return std::pow(three(rho, steps), 4);
    case Preset::babylon:
      return squared(saturated(babylon(alpha, steps, light), alpha));
    case Preset::free:
      return added(alpha2, formula.constant, formula.cap, steps);
    default:
      throw std::invalid_argument("a preset of half vectors");
  }
}

glm::dmat2 widened_matrix(Preset preset, double alpha2, const glm::dvec3& here, const glm::dvec3& right,
                          const glm::dvec3& above) {
  if (preset == Preset::tokuyoshi_kaplanyan_2021)
    return projected(alpha2, kernel(glm::dvec2(right) - glm::dvec2(here), glm::dvec2(above) - glm::dvec2(here)));
  return glm::dmat2(alpha2) + kernel(slope(right) - slope(here), slope(above) - slope(here));
}

double matrix_density(NormalDistribution distribution, const glm::dmat2& alpha2, const glm::dvec3& h) {
  if (h.z <= 0.0) return 0.0;
  const glm::dvec2 across(h);
  const double quadratic = glm::dot(across, glm::inverse(alpha2) * across);
  const double scale = 1.0 / (pi * std::sqrt(glm::determinant(alpha2)));
  if (distribution == NormalDistribution::ggx) return scale / squared(h.z * h.z + quadratic);
  return scale * std::exp(-quadratic / (h.z * h.z)) / std::pow(h.z, 4);
}

}  // namespace footprint::specular_aa
