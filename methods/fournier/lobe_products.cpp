// Closed forms of the products of two lobes, with first and second derivatives.
//
// The product of two exponentials of dot products is one of the vector kappa_a axis_a + kappa_b axis_b, of length R:
//   I = C_a C_b 2 pi e^{R - kappa_a - kappa_b} (1 - e^{-2R}) / R,   C = kappa / (2 pi (1 - e^{-2 kappa})),
// a function of kappa_a, kappa_b and c = axis_a . axis_b. With A(R) = coth R - 1/R, which is d/dR log(sinh R / R), and
// B = A / R, D = B' / R, the derivatives of l = log I are
//   l_c = B ka kb                        l_cc = D (ka kb)^2
//   l_a = B (ka + kb c) - A(ka)          l_ac = D ka kb (ka + kb c) + B kb      (and with a, b exchanged)
//                                        l_ab = D (ka + kb c) (kb + ka c) + B c
#include "methods/fournier/lobe_products.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/lobes/lobe.hpp"

namespace footprint::fournier {
namespace {

constexpr double largest_argument = 20.0;  // above it, e^{-2R} is nothing to the last bit
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

}  // namespace footprint::fournier
