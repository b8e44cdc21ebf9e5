// Closed forms that are stable for narrow lobes, and cubics between tabulated values.
#include "renderer/lobes/lobe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "renderer/core/error.hpp"
#include "renderer/core/names.hpp"
#include "renderer/core/numbers.hpp"

namespace footprint {
namespace {

using enum NormalDistribution;
using std::numbers::pi;

// Twins of the constants in common_lobes.glsl.
constexpr float narrowest_alpha = static_cast<float>(smallest_alpha);
constexpr float smallest_concentration = 1e-6F;
constexpr float largest_exponent = 2e6F;
constexpr float smallest_variance = 1e-12F;

constexpr auto distributions =
    std::to_array<Word<NormalDistribution>>({{NormalDistribution::blinn_phong, "blinn_phong"},
                                             {NormalDistribution::beckmann, "beckmann"},
                                             {NormalDistribution::ggx, "ggx"},
                                             {NormalDistribution::vmf, "vmf"}});

bool is_alpha(NormalDistribution distribution) { return distribution == beckmann || distribution == ggx; }

// 1 - cos^2 at u = 1 - cos.
double sine_squared(double u) { return u * (2.0 - u); }

// tan^2 where exp(-tan^2 / alpha^2) (1 + tan^2)^2 falls below the cutoff: a fixed point, since the logarithm is flat.
double beckmann_support(double alpha) {
  constexpr int rounds = 50;
  double tan2 = 0.0;
  for (int i = 0; i < rounds; ++i) tan2 = alpha * alpha * (2.0 * std::log1p(tan2) - std::log(lobe_cutoff));
  return 1.0 - 1.0 / std::sqrt(1.0 + tan2);
}

// u of sin^2 = s2 in the upper half.
double u_of_sine_squared(double s2) { return s2 >= 1.0 ? 1.0 : s2 / (1.0 + std::sqrt(1.0 - s2)); }

constexpr double smallest_amplitude_kappa = 1e-9;  // below it, the limit
constexpr double smallest_kappa = 0.05;            // of the mean: below it, series
constexpr double largest_kappa = 20.0;             // above it, tanh is 1 to the last bit

constexpr std::size_t intervals = 1024;  // 28 e-foldings: steps of 0.027, of which a cubic errs by 0.027^4 / 384
constexpr double widest = 0.35;          // radians: the support ends well above the horizon

}  // namespace

Lobe lobe_from_alpha(NormalDistribution distribution, float alpha) {
  const float bounded = std::max(alpha, narrowest_alpha);
  if (is_alpha(distribution)) return {distribution, bounded};
  const float kappa = 2.0F / (bounded * bounded);
  return {distribution, distribution == vmf ? kappa : kappa - 2.0F};
}

Lobe lobe_from_variance(NormalDistribution distribution, float variance) {
  if (!is_alpha(distribution))
    return {distribution, std::min(1.0F / std::max(variance, smallest_variance), largest_exponent)};
  const float alpha = std::max(std::sqrt(2.0F * variance), narrowest_alpha);
  return {distribution, distribution == ggx ? std::min(alpha, 1.0F) : alpha};
}

float lobe_variance(const Lobe& lobe) {
  const auto p = static_cast<float>(lobe.parameter);
  return is_alpha(lobe.distribution) ? 0.5F * p * p : 1.0F / std::max(p, smallest_concentration);
}

float lobe_roughness(const Lobe& lobe) {
  const double value = std::max(static_cast<float>(lobe.parameter), smallest_concentration);
  if (is_alpha(lobe.distribution)) return static_cast<float>(std::sqrt(value));
  return static_cast<float>(std::sqrt(std::sqrt(2.0 / (lobe.distribution == vmf ? value : value + 2.0))));
}

Lobe parse_lobe(std::string_view option, const std::string& text) {
  const std::size_t colon = text.find(':');
  const auto refuse = [&](const std::string& message) {
    return Error(ErrorKind::usage, std::string(option), fmt::format("`{}` {}", text, message),
                 "write it as blinn_phong:64, beckmann:0.2, ggx:0.2 or vmf:64");
  };
  const NormalDistribution distribution =
      word_value(distributions, std::string_view(text).substr(0, colon), "distribution", option);
  if (colon == std::string::npos) throw refuse("has no parameter");
  const auto parameter = parse_whole_of<double>(std::string_view(text).substr(colon + 1));
  if (!parameter) throw refuse("has a parameter that is not a number");
  const double least = is_alpha(distribution) ? smallest_alpha : 1e-3;
  const double most = is_alpha(distribution) ? 1.0 : 1e6;
  if (!(*parameter >= least && *parameter <= most)) throw refuse(fmt::format("is not within {} to {}", least, most));
  return {distribution, *parameter};
}

std::string lobe_text(const Lobe& lobe) {
  return fmt::format("{}:{}", word_for(distributions, lobe.distribution), static_cast<float>(lobe.parameter));
}

double lobe_peak(const Lobe& lobe) {
  const double p = lobe.parameter;
  if (is_alpha(lobe.distribution)) return 1.0 / (pi * p * p);
  return lobe.distribution == vmf ? vmf_peak(p) : (p + 1.0) / (2.0 * pi);
}

double lobe_shape(const Lobe& lobe, double u) {
  const double p = lobe.parameter;
  if (lobe.distribution == vmf) return std::exp(-p * u);
  if (u >= 1.0) return 0.0;
  if (lobe.distribution == blinn_phong) return std::exp(p * std::log1p(-u));
  const double c2 = (1.0 - u) * (1.0 - u);
  const double s2 = sine_squared(u);
  if (lobe.distribution == beckmann) return std::exp(-s2 / (c2 * p * p)) / (c2 * c2);
  const double widened = c2 + s2 / (p * p);
  return 1.0 / (widened * widened);
}

double lobe_support(const Lobe& lobe) {
  const double p = lobe.parameter;
  const double folds = -std::log(lobe_cutoff);
  if (lobe.distribution == blinn_phong) return -std::expm1(-folds / p);
  if (lobe.distribution == vmf) return std::min(folds / p, 2.0);
  if (lobe.distribution == beckmann) return beckmann_support(p);
  // c^2 + s^2 / alpha^2 = 1 + s^2 (1 / alpha^2 - 1) reaches the root of 1 / cutoff.
  return u_of_sine_squared(p < 1.0 ? (1.0 / std::sqrt(lobe_cutoff) - 1.0) / (1.0 / (p * p) - 1.0) : 1.0);
}

double lobe_width(const Lobe& lobe) {
  const double p = lobe.parameter;
  return is_alpha(lobe.distribution) ? p * std::numbers::sqrt2 / 2.0 : 1.0 / std::sqrt(p);
}

double lobe_energy(const Lobe& lobe, double n_z) {
  // u = q w / (1 - w) spreads the nodes w over the core and the tail alike.
  constexpr int nodes = 512;
  const double support = lobe_support(lobe);
  const double q = 2.0 * lobe_width(lobe) * lobe_width(lobe);
  const double last = support / (support + q);
  const double axis_sine = std::sqrt(std::max(1.0 - n_z * n_z, 0.0));
  double sum = 0.0;
  for (int i = 0; i < nodes; ++i) {
    const double w = last * (i + 0.5) / nodes;
    const double u = q * w / (1.0 - w);
    const double ring = axis_sine * std::sqrt(sine_squared(u));  // z over a ring: n_z (1 - u) + ring cos(azimuth)
    const double lift = n_z * (1.0 - u);
    const double above = ring > 1e-12 ? std::acos(std::clamp(-lift / ring, -1.0, 1.0)) / pi : (lift > 0.0 ? 1.0 : 0.0);
    sum += lobe_shape(lobe, u) * above * q / ((1.0 - w) * (1.0 - w));
  }
  return 2.0 * pi * lobe_peak(lobe) * sum * last / nodes;
}

double vmf_integral(double kappa) { return kappa > 0.0 ? -2.0 * pi * std::expm1(-2.0 * kappa) / kappa : 4.0 * pi; }

double vmf_peak(double kappa) {
  return kappa < smallest_amplitude_kappa ? 0.25 / pi : kappa / (2.0 * pi * -std::expm1(-2.0 * kappa));
}

double vmf_amplitude(double kappa) {
  if (kappa > largest_kappa) return kappa;  // e^{-2 kappa} is nothing to the last bit
  return kappa < smallest_amplitude_kappa ? 0.5 : kappa / -std::expm1(-2.0 * kappa);
}

VmfMean vmf_mean(double kappa) {
  const double k2 = kappa * kappa;
  if (kappa < smallest_kappa)
    return {1.0 / 3.0 - k2 * (1.0 / 45.0 - k2 * 2.0 / 945.0), -2.0 / 45.0 + k2 * (8.0 / 945.0 - k2 * 2.0 / 1575.0)};
  if (kappa > largest_kappa) return {(1.0 - 1.0 / kappa) / kappa, (2.0 / kappa - 1.0) / (k2 * kappa)};
  const double b = (1.0 / std::tanh(kappa) - 1.0 / kappa) / kappa;
  const double sinh = std::sinh(kappa);
  return {b, (1.0 / k2 - 1.0 / (sinh * sinh) - b) / k2};
}

double vmf_kappa_of_shortfall(double q) { return (1.0 - q) * (2.0 + 2.0 * q - q * q) / (q * (2.0 - q)); }

double vmf_shortfall(double kappa) {
  constexpr int steps = 6;
  double q = kappa >= 1.0 ? 1.0 / (kappa + 0.5) : 1.0 / (1.0 + kappa / 3.0);
  for (int step = 0; step < steps; ++step)
    q -= (((q + kappa - 3.0) * q - 2.0 * kappa) * q + 2.0) / ((3.0 * q + 2.0 * (kappa - 3.0)) * q - 2.0 * kappa);
  return q;
}

LobeProfile::LobeProfile(const Lobe& lobe) : lobe_(lobe) {
  if (lobe.distribution == NormalDistribution::ggx || lobe_width(lobe) > widest) return;
  const double step = lobe_support(lobe) / intervals;
  scale_ = 1.0 / step;
  const double nudge = 1e-4;  // of a step, for slopes by central differences
  const auto shape = [&](double node) { return lobe_shape(lobe, node * step); };
  const auto slope = [&](double node) {
    if (node == 0.0) return (4.0 * shape(nudge) - shape(2.0 * nudge) - 3.0 * shape(0.0)) / (2.0 * nudge);
    return (shape(node + nudge) - shape(node - nudge)) / (2.0 * nudge);
  };
  cubics_.reserve(intervals);
  for (std::size_t i = 0; i < intervals; ++i) {
    const double a = static_cast<double>(i), b = a + 1.0;
    const double rise = shape(b) - shape(a);
    const double slope_a = slope(a), slope_b = slope(b);
    cubics_.push_back({shape(a), slope_a, 3.0 * rise - 2.0 * slope_a - slope_b, slope_a + slope_b - 2.0 * rise});
  }
}

Alphas anisotropic_alphas(double strength, double alpha) {
  return {alpha + (1.0 - alpha) * strength * strength, alpha};
}

double round_alpha(const Alphas& alphas) {
  return std::sqrt(0.5 * (alphas.along * alphas.along + alphas.across * alphas.across));
}

glm::dvec2 stretch_of(const Alphas& alphas, double rotation) {
  const double along2 = alphas.along * alphas.along, across2 = alphas.across * alphas.across;
  return (along2 - across2) / (along2 + across2) * glm::dvec2(std::cos(2.0 * rotation), std::sin(2.0 * rotation));
}

Alphas alphas_of_stretch(double round, const glm::dvec2& stretch) {
  const double r = std::min(glm::length(stretch), 1.0);
  return {round * std::sqrt(1.0 + r), std::max(round * std::sqrt(1.0 - r), smallest_alpha)};
}

double rotation_of_stretch(const glm::dvec2& stretch) { return 0.5 * std::atan2(stretch.y, stretch.x); }

double anisotropic_density(NormalDistribution distribution, const Alphas& alphas, double rotation,
                           const glm::dvec3& own) {
  const double c = std::cos(rotation), s = std::sin(rotation);
  const glm::dvec2 stretched{(c * own.x + s * own.y) / alphas.along, (c * own.y - s * own.x) / alphas.across};
  const double squared = glm::dot(stretched, stretched), cosine = own.z;
  const double norm = std::numbers::pi * alphas.along * alphas.across;
  if (distribution == NormalDistribution::ggx) {
    const double d = squared + cosine * cosine;
    return cosine > 0.0 ? 1.0 / (norm * d * d) : 0.0;
  }
  if (cosine <= 1e-3) return 0.0;  // the exponential has long been zero
  const double cosine2 = cosine * cosine;
  return std::exp(-squared / cosine2) / (norm * cosine2 * cosine2);
}

}  // namespace footprint
