// Levenberg-Marquardt over the parameters of the peaks, with all inner products in closed form.
//
// The residual, peaks minus target, is a function on the sphere, and so are its derivatives J by the parameters. Their
// inner products are sums of products of lobes in closed form. No direction is sampled, so lobes may be arbitrarily
// narrow.
//
// Closed forms of the inner products of two lobes, with first and second derivatives.
//
// The product of two exponentials of dot products is one of the vector kappa_a axis_a + kappa_b axis_b, of length R:
//   I = C_a C_b 2 pi e^{R - kappa_a - kappa_b} (1 - e^{-2R}) / R,   C = kappa / (2 pi (1 - e^{-2 kappa})),
// a function of kappa_a, kappa_b and c = axis_a . axis_b. With A(R) = coth R - 1/R, which is d/dR log(sinh R / R), and
// B = A / R, D = B' / R, the derivatives of l = log I are
//   l_c = B ka kb                        l_cc = D (ka kb)^2
//   l_a = B (ka + kb c) - A(ka)          l_ac = D ka kb (ka + kb c) + B kb      (and with a, b exchanged)
//                                        l_ab = D (ka + kb c) (kb + ka c) + B c
#include "methods/fournier/peaks.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "methods/fournier/least_squares.hpp"
#include "renderer/lobes/lobe.hpp"

namespace footprint::fournier {
namespace {

constexpr double largest_argument = 20.0;  // above it, e^{-2R} is below the last bit
constexpr double negligible_exponent = -60.0;

// c, R and I of two lobes.
struct Pair {
  double cosine, r, value;
};

Pair pair_of(const VmfLobe& a, const VmfLobe& b) {
  const double u = 0.5 * (a.axis - b.axis).squaredNorm();  // 1 - c without cancellation
  const double sum = a.kappa + b.kappa;
  const double r = std::sqrt(std::max(sum * sum - 2.0 * a.kappa * b.kappa * u, 0.0));
  const double exponent = -2.0 * a.kappa * b.kappa * u / (r + sum);  // R - kappa_a - kappa_b
  if (exponent < negligible_exponent) return {1.0 - u, r, 0.0};
  const double mass = r > largest_argument ? 1.0 / r : r < 1e-9 ? 2.0 : -std::expm1(-2.0 * r) / r;
  const double scale = vmf_amplitude(a.kappa) * vmf_amplitude(b.kappa) / (2.0 * std::numbers::pi);
  return {1.0 - u, r, scale * mass * std::exp(exponent)};
}

double log_by_kappa(const VmfLobe& lobe, double other_kappa, double cosine, double b) {
  return b * (lobe.kappa + other_kappa * cosine) - vmf_mean(lobe.kappa).by_kappa * lobe.kappa;
}

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

constexpr int parameters_per_peak = 4;      // root of the weight, deviation, two of the axis
constexpr double smallest_variance = 5e-7;  // the narrowest lobe of the shaders
constexpr double largest_variance = 100.0;  // wider ones differ from the uniform one by 1%
constexpr double negligible = 1e-6;         // of Q over the target's norm: an error below a thousandth
constexpr double least_deviation = 0.05;  // of the base lobe's: at 0 the derivative vanishes and a peak could not widen
constexpr double tolerance = 1e-3;        // relative change of Q or of the parameters at convergence

double bounded(double variance) { return std::clamp(variance, smallest_variance, largest_variance); }

VmfLobe lobe_of(const Peak& peak, double base_variance) {
  VmfLobe lobe;
  lobe.axis = peak.axis;
  lobe.kappa = 1.0 / bounded(base_variance + peak.spread);
  return lobe;
}

// Two unit vectors perpendicular to an axis.
std::pair<Eigen::Vector3d, Eigen::Vector3d> tangents(const Eigen::Vector3d& axis) {
  const Eigen::Vector3d s = axis.unitOrthogonal();
  return {s, axis.cross(s)};
}

// The state at a point of parameter space.
struct Point {
  Vector weights;     // sum to one
  Vector roots;       // weights = roots^2 / sum roots^2
  Vector deviations;  // spread = deviation^2
  std::vector<VmfLobe> lobes;
};

// Q as a function of the parameters. Weights are relative to the total weight of the target.
class Objective {
 public:
  Objective(std::span<const Peak> target, std::span<const Peak> start, double base_variance)
      : base_variance_(bounded(base_variance)) {
    for (const Peak& peak : target) total_ += peak.weight;
    for (const Peak& peak : target) {
      target_.push_back(lobe_of(peak, base_variance_));
      target_weights_.push_back(peak.weight / total_);
    }
    for (const Peak& peak : start) {
      centres_.push_back(peak.axis);
      tangents_.push_back(tangents(peak.axis));
    }
    target_norm_ = norm_of_target();
  }

  [[nodiscard]] Eigen::Index size() const { return parameters_per_peak * static_cast<Eigen::Index>(centres_.size()); }
  [[nodiscard]] double target_norm() const { return target_norm_; }

  [[nodiscard]] Vector parameters_of(std::span<const Peak> peaks) const {
    Vector x(size());
    const double least = least_deviation * std::sqrt(base_variance_);
    for (std::size_t i = 0; i < peaks.size(); ++i) {
      const double deviation = std::max(std::sqrt(peaks[i].spread), least);
      x.segment<parameters_per_peak>(first(i)) << std::sqrt(peaks[i].weight / total_), deviation, 0.0, 0.0;
    }
    return x;
  }

  [[nodiscard]] std::vector<Peak> peaks_at(const Vector& x) const {
    const Point point = point_at(x);
    std::vector<Peak> peaks;
    for (std::size_t i = 0; i < point.lobes.size(); ++i) {
      const auto index = static_cast<Eigen::Index>(i);
      const double deviation = point.deviations[index];
      peaks.push_back(
          {total_ * point.weights[index], point.lobes[i].axis, std::min(deviation * deviation, largest_spread)});
    }
    std::ranges::stable_sort(peaks, std::greater{}, &Peak::weight);
    return peaks;
  }

  // Q and its derivatives by the parameters of `peaks_at`.
  [[nodiscard]] Squares evaluate(const Vector& x) const {
    const Point point = point_at(x);
    const Matrix products = products_of_peaks(point);
    const Vector with_target = products_with_target(point);
    Vector amplitudes = Vector::Zero(size());
    for (std::size_t i = 0; i < point.lobes.size(); ++i)
      amplitudes[first(i)] = point.weights[static_cast<Eigen::Index>(i)];
    const Vector residual = products * amplitudes - with_target;
    return {.q = std::max(amplitudes.dot(residual) - amplitudes.dot(with_target) + target_norm_, 0.0),
            .gradient = by_parameters(point, residual),
            .gram = by_parameters(point, by_parameters(point, products).transpose())};
  }

 private:
  static Eigen::Index first(std::size_t i) { return parameters_per_peak * static_cast<Eigen::Index>(i); }

  [[nodiscard]] double norm_of_target() const {
    double sum = 0.0;
    for (std::size_t i = 0; i < target_.size(); ++i) {
      double row = 0.5 * target_weights_[i] * product(target_[i], target_[i]);
      for (std::size_t j = 0; j < i; ++j) row += target_weights_[j] * product(target_[i], target_[j]);
      sum += 2.0 * target_weights_[i] * row;
    }
    return sum;
  }

  [[nodiscard]] Point point_at(const Vector& x) const {
    const auto count = static_cast<Eigen::Index>(centres_.size());
    const Eigen::Map<const Vector, 0, Eigen::InnerStride<parameters_per_peak>> roots(x.data(), count);
    const Eigen::Map<const Vector, 0, Eigen::InnerStride<parameters_per_peak>> deviations(x.data() + 1, count);
    Point point{.weights = roots.cwiseAbs2() / std::max(roots.squaredNorm(), 1e-300),
                .roots = roots,
                .deviations = deviations,
                .lobes = {}};
    for (std::size_t i = 0; i < centres_.size(); ++i) {
      const auto& [s, t] = tangents_[i];
      const Eigen::Vector3d off = centres_[i] + x[first(i) + 2] * s + x[first(i) + 3] * t;
      const double length = off.norm();
      const Eigen::Vector3d axis = off / length;
      const double deviation = x[first(i) + 1];
      point.lobes.push_back({.axis = axis,
                             .kappa = 1.0 / bounded(base_variance_ + deviation * deviation),
                             .axis_by_s = (s - axis * axis.dot(s)) / length,
                             .axis_by_t = (t - axis * axis.dot(t)) / length});
    }
    return point;
  }

  // Products of each lobe and its derivatives with those of every other lobe, in 4 x 4 blocks.
  [[nodiscard]] Matrix products_of_peaks(const Point& point) const {
    Matrix products(size(), size());
    for (std::size_t i = 0; i < point.lobes.size(); ++i) {
      for (std::size_t j = 0; j <= i; ++j) {
        const Eigen::Matrix4d block = products_of_derivatives(point.lobes[i], point.lobes[j]);
        products.block<4, 4>(first(i), first(j)) = block;
        products.block<4, 4>(first(j), first(i)) = block.transpose();
      }
    }
    return products;
  }

  [[nodiscard]] Vector products_with_target(const Point& point) const {
    Vector products = Vector::Zero(size());
    for (std::size_t i = 0; i < point.lobes.size(); ++i) {
      for (std::size_t j = 0; j < target_.size(); ++j)
        products.segment<4>(first(i)) += target_weights_[j] * products_with_derivatives(point.lobes[i], target_[j]);
    }
    return products;
  }

  // Transforms values over lobes and their derivatives (rows) to derivatives by the parameters: a sparse chain rule.
  [[nodiscard]] Matrix by_parameters(const Point& point, const Matrix& rows) const {
    const double sum = std::max(point.roots.squaredNorm(), 1e-300);
    Eigen::RowVectorXd mean = Eigen::RowVectorXd::Zero(rows.cols());
    for (std::size_t k = 0; k < point.lobes.size(); ++k)
      mean += point.weights[static_cast<Eigen::Index>(k)] * rows.row(first(k));
    Matrix out(rows.rows(), rows.cols());
    for (std::size_t i = 0; i < point.lobes.size(); ++i) {
      const auto index = static_cast<Eigen::Index>(i);
      const double kappa = point.lobes[i].kappa;
      const double weight = point.weights[index];
      const double deviation = point.deviations[index];
      const bool is_free = base_variance_ + deviation * deviation < largest_variance;
      out.row(first(i)) = (2.0 * point.roots[index] / sum) * (rows.row(first(i)) - mean);
      out.row(first(i) + 1) = (is_free ? weight * -2.0 * deviation * kappa * kappa : 0.0) * rows.row(first(i) + 1);
      out.middleRows<2>(first(i) + 2) = weight * rows.middleRows<2>(first(i) + 2);
    }
    return out;
  }

  double base_variance_;
  double total_ = 0.0;
  std::vector<VmfLobe> target_;
  std::vector<double> target_weights_;
  std::vector<Eigen::Vector3d> centres_;
  std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> tangents_;
  double target_norm_ = 0.0;
};

}  // namespace

double product(const VmfLobe& a, const VmfLobe& b) { return pair_of(a, b).value; }

Eigen::Vector4d products_with_derivatives(const VmfLobe& a, const VmfLobe& b) {
  const Pair pair = pair_of(a, b);
  if (pair.value == 0.0) return Eigen::Vector4d::Zero();
  const double langevin_b = vmf_mean(pair.r).by_kappa;
  const double by_cosine = langevin_b * a.kappa * b.kappa;
  return pair.value * Eigen::Vector4d(1.0, log_by_kappa(a, b.kappa, pair.cosine, langevin_b),
                                      by_cosine * a.axis_by_s.dot(b.axis), by_cosine * a.axis_by_t.dot(b.axis));
}

Eigen::Matrix4d products_of_derivatives(const VmfLobe& a, const VmfLobe& b) {
  const Pair pair = pair_of(a, b);
  if (pair.value == 0.0) return Eigen::Matrix4d::Zero();
  const auto [langevin_b, langevin_d] = vmf_mean(pair.r);
  const double kk = a.kappa * b.kappa;
  const double along_a = a.kappa + b.kappa * pair.cosine;
  const double along_b = b.kappa + a.kappa * pair.cosine;
  const double l_c = langevin_b * kk;
  const double l_a = log_by_kappa(a, b.kappa, pair.cosine, langevin_b);
  const double l_b = log_by_kappa(b, a.kappa, pair.cosine, langevin_b);
  const double by_c_c = l_c * l_c + langevin_d * kk * kk;
  const double by_a_c = l_a * l_c + langevin_d * kk * along_a + langevin_b * b.kappa;
  const double by_b_c = l_b * l_c + langevin_d * kk * along_b + langevin_b * a.kappa;
  const double by_a_b = l_a * l_b + langevin_d * along_a * along_b + langevin_b * pair.cosine;
  const Eigen::Vector2d c_a(a.axis_by_s.dot(b.axis), a.axis_by_t.dot(b.axis));
  const Eigen::Vector2d c_b(a.axis.dot(b.axis_by_s), a.axis.dot(b.axis_by_t));
  Eigen::Matrix2d c_ab;
  c_ab << a.axis_by_s.dot(b.axis_by_s), a.axis_by_s.dot(b.axis_by_t), a.axis_by_t.dot(b.axis_by_s),
      a.axis_by_t.dot(b.axis_by_t);
  Eigen::Matrix4d out;
  out.topLeftCorner<2, 2>() << 1.0, l_b, l_a, by_a_b;
  out.topRightCorner<1, 2>() = l_c * c_b.transpose();
  out.block<1, 2>(1, 2) = by_a_c * c_b.transpose();
  out.block<2, 1>(2, 0) = l_c * c_a;
  out.block<2, 1>(2, 1) = by_b_c * c_a;
  out.bottomRightCorner<2, 2>() = by_c_c * c_a * c_b.transpose() + l_c * c_ab;
  return pair.value * out;
}

Fit fit_peaks(std::span<const Peak> target, std::span<const Peak> start, double base_variance, int evaluations) {
  const Objective objective(target, start, base_variance);
  const auto relative_error = [&](double q) { return std::sqrt(q / objective.target_norm()); };
  Vector x = objective.parameters_of(start);
  Fit fit;
  fit.start_error = relative_error(objective.evaluate(x).q);
  fit.converged = minimise(
      [&](const Vector& at) { return objective.evaluate(at); },
      {.tolerance = tolerance, .most_evaluations = evaluations, .negligible = negligible * objective.target_norm()}, x);
  fit.peaks = objective.peaks_at(x);
  fit.error = relative_error(objective.evaluate(x).q);
  return fit;
}

}  // namespace footprint::fournier
