// Log densities of the four base lobes with derivatives by 1 - cosine and by variance; the chain rule to means,
// deviations and spreads.
#include "methods/best_lobes/lobe_shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace footprint::best_lobes {
namespace {

using std::numbers::pi;
using enum NormalDistribution;

constexpr double widest_ggx = 0.5;           // slope variance of alpha = 1, which common_lobes.glsl stops at
constexpr double narrowest_variance = 5e-7;  // of the shaders
constexpr double farthest = 1000.0;
constexpr double least_log = -40.0;  // of a density: below it, 0
constexpr double widened = 1.2;      // a variance whose support still counts as the base lobe's

// The plain integral of a microfacet lobe over solid angle (lobeEnergy of common_lobes.glsl).
double energy_of(NormalDistribution distribution, double variance) {
  const double a2 = 2.0 * variance;
  const double alpha = std::sqrt(a2);
  if (distribution == ggx) {
    const double t = std::sqrt(std::max(1.0 - a2, 0.0));
    return 1.0 + a2 * (t < 0.03 ? 1.0 + t * t / 3.0 : std::log((1.0 + t) / alpha) / t);
  }
  if (distribution != beckmann) return 1.0;
  const double side = 1.0 + 1.588 * alpha;
  const double c = (2.0 * side + 2.492 * a2) / (side + 1.957 * a2);
  return 1.0 + a2 / (1.0 + std::sqrt(1.0 + c * a2));
}

// The log of the density at u = 1 - cosine, and its derivatives.
struct LogDensity {
  double value, by_u, by_variance;
};

// The base lobe of one variance, with the energy of another.
class RadialLobe {
 public:
  RadialLobe(NormalDistribution distribution, double variance, double energy_variance)
      : distribution_(distribution),
        is_clamped_(distribution == ggx && variance >= widest_ggx),
        variance_(std::max(is_clamped_ ? widest_ggx : variance, narrowest_variance)) {
    const double own = energy_of(distribution, variance_);
    const double step = 1e-5 * variance_;
    log_energy_ = std::log(energy_of(distribution, energy_variance) / own);
    log_energy_by_variance_ =
        (energy_of(distribution, variance_ - step) - energy_of(distribution, variance_ + step)) / (2.0 * step * own);
    const double k = 1.0 / variance_;
    const double twice = std::exp(-2.0 * k);
    switch (distribution) {
      case vmf:
        norm_ = std::log(k / (2.0 * pi * -std::expm1(-2.0 * k)));
        norm_by_variance_ = -k * k * (1.0 / k - 2.0 * twice / -std::expm1(-2.0 * k));
        break;
      case blinn_phong:
        norm_ = std::log((k + 1.0) / (2.0 * pi));
        norm_by_variance_ = -k * k / (k + 1.0);
        break;
      case beckmann:
        norm_ = -std::log(2.0 * pi * variance_);
        norm_by_variance_ = -k;
        break;
      case ggx:
        norm_ = std::log(2.0 * variance_ / pi);
        norm_by_variance_ = k;
        break;
    }
  }

  [[nodiscard]] LogDensity at(double u) const {
    const LogDensity shape = shape_at(u);
    return {norm_ + log_energy_ + shape.value, shape.by_u,
            is_clamped_ ? 0.0 : norm_by_variance_ + log_energy_by_variance_ + shape.by_variance};
  }

 private:
  [[nodiscard]] LogDensity shape_at(double u) const {
    constexpr LogDensity none{-1e30, 0.0, 0.0};
    const double c = 1.0 - u;
    const double k = 1.0 / variance_;
    if (distribution_ == vmf) return {-k * u, -k, k * k * u};
    if (c <= 1e-3) return none;
    if (distribution_ == blinn_phong) {
      const double log_cosine = std::log1p(-u);
      return {k * log_cosine, -k / c, -k * k * log_cosine};
    }
    const double sine2 = u * (2.0 - u);
    if (distribution_ == beckmann) {
      const double tan2 = sine2 / (c * c);
      return {-0.5 * k * tan2 - 4.0 * std::log(c), -k / (c * c * c) + 4.0 / c, 0.5 * k * k * tan2};
    }
    const double a2 = 2.0 * variance_;
    const double d = a2 * c * c + sine2;
    return {-2.0 * std::log(d), -4.0 * (1.0 - a2) * c / d, -4.0 * c * c / d};
  }

  NormalDistribution distribution_;
  bool is_clamped_;
  double variance_;
  double norm_ = 0.0, norm_by_variance_ = 0.0;
  double log_energy_ = 0.0, log_energy_by_variance_ = 0.0;
};

// A of stretched_part.glsl, and the log of det A times what goes below the horizon.
struct Stretch {
  double xx, xy, yy, log_scale;
};

// tailsGivenBack of stretched_part.glsl.
double tails_given_back(double variance, double s) {
  const double a2 = 2.0 * variance;
  const double t = std::sqrt(std::max(1.0 - a2, 1e-4));
  const double c = (s - 1.0) / (s + 1.0);
  const double beyond = a2 * (c / (1.0 - t * t * c * c) + 0.5 * std::log((1.0 + t * c) / (1.0 - t * c)) / t);
  const double energy = energy_of(ggx, variance);
  return energy / std::max(energy - beyond, 0.5 * energy);
}

Stretch stretch_of(NormalDistribution distribution, double base_variance, const FittedLobe& lobe) {
  const double variance = base_variance + lobe.deviation * lobe.deviation;
  const double w = variance * plane_variance(lobe.mean);
  const Eigen::Vector3d ratio = lobe.spread() / w;
  const double trace = ratio.x() + ratio.z();
  const double minors = lobe.root.x() * lobe.root.z() / w;
  const double s = std::sqrt(1.0 + trace + minors * minors);
  const double t = std::sqrt(2.0 + trace + 2.0 * s);
  const double tails = distribution == ggx ? tails_given_back(std::min(variance, widest_ggx), s) : 1.0;
  return {(1.0 + ratio.z() + s) / (s * t), -ratio.y() / (s * t), (1.0 + ratio.x() + s) / (s * t), std::log(tails / s)};
}

}  // namespace

Eigen::Vector2d plane_from_direction(const Eigen::Vector3d& direction) {
  const double below = std::max(1.0 + direction.z(), 1e-12);
  const Eigen::Vector2d p = direction.head<2>() / below;
  const double length = p.norm();
  return length > farthest ? Eigen::Vector2d(p * (farthest / length)) : p;
}

Eigen::Vector3d direction_from_plane(const Eigen::Vector2d& p) {
  const double q = p.squaredNorm();
  return Eigen::Vector3d(2.0 * p.x(), 2.0 * p.y(), 1.0 - q) / (1.0 + q);
}

double plane_variance(const Eigen::Vector2d& p) {
  const double scale = 0.5 * (1.0 + p.squaredNorm());
  return scale * scale;
}

LobeFamily::LobeFamily(NormalDistribution distribution, double variance, Shape shape)
    : distribution_(distribution), variance_(std::max(variance, narrowest_variance)), support_(2.0), shape_(shape) {
  if (distribution == ggx) variance_ = std::min(variance_, widest_ggx);
  support_ = lobe_support(lobe_from_variance(distribution, static_cast<float>(widened * variance_)));
}

double LobeFamily::width() const {
  return lobe_width(lobe_from_variance(distribution_, static_cast<float>(variance_)));
}

double LobeFamily::energy(double spread) const {
  return energy_of(distribution_, variance_ + spread) / energy_of(distribution_, variance_);
}

// D(h) = scale ((1 + |p|^2) / (1 + |p'|^2))^2 D_base(h'), p' = m + A (p - m), u = 2 |p' - m|^2 / ((1 + |p'|^2) (1 +
// |m|^2)), half the square of a chord. The derivatives of A and scale by the parameters are differences, once for a
// lobe; all others are exact.
void LobeFamily::evaluate(const FittedLobe& lobe, const Directions& directions, Eigen::Ref<Eigen::VectorXd> values,
                          Eigen::Ref<Eigen::MatrixXd> derivatives) const {
  const RadialLobe radial(distribution_, variance_ + lobe.deviation * lobe.deviation, variance_);
  const Stretch a = stretch_of(distribution_, variance_, lobe);
  const double step = 1e-5 * std::sqrt(variance_ * plane_variance(lobe.mean));
  std::array<Stretch, 6> by{};
  for (std::size_t k = 0; k < by.size(); ++k) {
    FittedLobe more = lobe, less = lobe;
    more.parameter(static_cast<Eigen::Index>(k)) += step;
    less.parameter(static_cast<Eigen::Index>(k)) -= step;
    const Stretch up = stretch_of(distribution_, variance_, more);
    const Stretch down = stretch_of(distribution_, variance_, less);
    by[k] = {(up.xx - down.xx) / (2.0 * step), (up.xy - down.xy) / (2.0 * step), (up.yy - down.yy) / (2.0 * step),
             (up.log_scale - down.log_scale) / (2.0 * step)};
  }
  const double mx = lobe.mean.x();
  const double my = lobe.mean.y();
  const double metric = 1.0 + mx * mx + my * my;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const double dx = directions.x[i] - mx;
    const double dy = directions.y[i] - my;
    const double qx = a.xx * dx + a.xy * dy;
    const double qy = a.xy * dx + a.yy * dy;
    const double px = mx + qx;
    const double py = my + qy;
    const double own = 1.0 + px * px + py * py;
    const double factor = 2.0 / (own * metric);
    const double u = factor * (qx * qx + qy * qy);
    const LogDensity at = radial.at(u);
    const double ratio = (1.0 + directions.x[i] * directions.x[i] + directions.y[i] * directions.y[i]) / own;
    const double log_value = at.value + a.log_scale + 2.0 * std::log(ratio);
    if (log_value < least_log) {
      values[row] = 0.0;
      derivatives.row(row).setZero();
      continue;
    }
    const double value = std::exp(log_value) * directions.root_of_angle[i];
    values[row] = value;
    // By p' alone, and by q through both u and p'.
    const double pull = -4.0 / own - 2.0 * at.by_u * u / own;
    const double gx = pull * px + 2.0 * at.by_u * factor * qx;
    const double gy = pull * py + 2.0 * at.by_u * factor * qy;
    const auto through_a = [&](const Stretch& d) {
      return d.log_scale + gx * (d.xx * dx + d.xy * dy) + gy * (d.xy * dx + d.yy * dy);
    };
    const double by_metric = -2.0 * at.by_u * u / metric;
    derivatives(row, 0) = value * (through_a(by[0]) + pull * px + by_metric * mx - (a.xx * gx + a.xy * gy));
    derivatives(row, 1) = value * (through_a(by[1]) + pull * py + by_metric * my - (a.xy * gx + a.yy * gy));
    derivatives(row, 2) = value * (through_a(by[2]) + 2.0 * lobe.deviation * at.by_variance);
    for (Eigen::Index k = 3; k < parameters(); ++k)
      derivatives(row, k) = value * through_a(by[static_cast<std::size_t>(k)]);
  }
}

void LobeFamily::add_round(double weight, const Eigen::Vector2d& mean, double spread, const Directions& directions,
                           Eigen::Ref<Eigen::VectorXd> values) const {
  const RadialLobe radial(distribution_, variance_ + spread, variance_);
  const double support = spread <= (widened - 1.0) * variance_ ? support_ : 2.0;
  const double metric = 1.0 + mean.squaredNorm();
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const double dx = directions.x[i] - mean.x();
    const double dy = directions.y[i] - mean.y();
    const double square = 1.0 + directions.x[i] * directions.x[i] + directions.y[i] * directions.y[i];
    const double u = 2.0 * (dx * dx + dy * dy) / (square * metric);
    if (u > support) continue;
    values[static_cast<Eigen::Index>(i)] += weight * std::exp(radial.at(u).value) * directions.root_of_angle[i];
  }
}

}  // namespace footprint::best_lobes
