// Both densities in double precision by their formulas, written without the shaders.
#include "tests/support/slope_twin.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/bake/slope_moments.hpp"

namespace footprint::testing {
namespace {

using std::numbers::pi;

// M^-1/2 of a symmetric matrix by its eigenvectors (one Jacobi rotation makes a 2 x 2 matrix diagonal).
glm::dmat2 inverse_root(const glm::dmat2& m) {
  const double angle = 0.5 * std::atan2(2.0 * m[0][1], m[0][0] - m[1][1]);
  const glm::dmat2 turn(std::cos(angle), std::sin(angle), -std::sin(angle), std::cos(angle));
  const glm::dmat2 diagonal = glm::transpose(turn) * m * turn;
  return turn * glm::dmat2(1.0 / std::sqrt(diagonal[0][0]), 0, 0, 1.0 / std::sqrt(diagonal[1][1])) *
         glm::transpose(turn);
}

// d(-m_xy / m_z) for m = n + t dt: one column for each of two tangents of n.
glm::dmat2 slope_jacobian(const glm::dvec3& n) {
  const glm::dvec3 helper = std::abs(n.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 s = glm::normalize(glm::cross(helper, n));
  const glm::dvec3 t = glm::cross(n, s);
  const auto column = [&](const glm::dvec3& d) { return -(glm::dvec2(d) * n.z - glm::dvec2(n) * d.z) / (n.z * n.z); };
  return {column(s), column(t)};
}

}  // namespace

double base_density(NormalDistribution distribution, double lobe, const glm::dvec3& n, const glm::dvec3& h) {
  const double u = 0.5 * glm::dot(h - n, h - n);
  const double c = 1.0 - u;
  const glm::dvec3 sine = glm::cross(n, h);
  const double tan2 = glm::dot(sine, sine) / (c * c);
  switch (distribution) {
    case NormalDistribution::blinn_phong:
      return c <= 0.0 ? 0.0 : (lobe + 1.0) / (2.0 * pi) * std::exp(lobe * std::log1p(-u));
    case NormalDistribution::vmf:
      return lobe / (-2.0 * pi * std::expm1(-2.0 * lobe)) * std::exp(-lobe * u);
    case NormalDistribution::beckmann:
      return c <= 1e-3 ? 0.0 : std::exp(-tan2 / (lobe * lobe)) / (pi * lobe * lobe * std::pow(c, 4.0));
    case NormalDistribution::ggx:
      break;
  }
  const double width = lobe * lobe * c * c + glm::dot(sine, sine);
  return c <= 0.0 ? 0.0 : lobe * lobe / (pi * width * width);
}

double mean_facet_density(const Material& material, const glm::dvec3& h) {
  const Image normals = material.normal_map->image.decoded();
  double sum = 0;
  double weight = 0;
  for (std::size_t i = 0; i < normals.texels.size(); i += 4) {
    if (normals.texels[i + 3] <= 0.0F) continue;
    const glm::dvec3 n(normals.texels[i], normals.texels[i + 1], normals.texels[i + 2]);
    sum += base_density(material.brdf.distribution, *material.lobe_parameter, glm::normalize(n), h);
    weight += 1.0;
  }
  return sum / weight;
}

glm::dvec3 SlopeTwin::axis() const { return glm::normalize(glm::dvec3(-mean, 1.0)); }

double SlopeTwin::variance() const { return lobe_variance({distribution, lobe}); }

double SlopeTwin::stretched(const glm::dvec3& h) const {
  const double v = variance();
  const double cosine = std::max(h.z, 1e-3);
  const glm::dmat2 jacobian = slope_jacobian(axis());
  const glm::dmat2 back = glm::inverse(jacobian);
  const glm::dmat2 shrink = inverse_root(glm::dmat2(1.0) + back * spread * glm::transpose(back) / v);
  const glm::dvec2 slope = -glm::dvec2(h) / cosine;
  const glm::dvec2 at = mean + jacobian * shrink * back * (slope - mean);
  const glm::dvec3 base = glm::normalize(glm::dvec3(-at, 1.0));
  return base_density(distribution, lobe, axis(), base) * glm::determinant(shrink) * std::pow(base.z / cosine, 3.0);
}

double SlopeTwin::gaussian(const glm::dvec3& h) const {
  const double cosine = std::max(h.z, 1e-3);
  const glm::dmat2 covariance = spread + glm::dmat2(variance());
  const glm::dvec2 offset = -glm::dvec2(h) / cosine - mean;
  return std::exp(-0.5 * glm::dot(offset, glm::inverse(covariance) * offset)) /
         (2.0 * pi * std::sqrt(glm::determinant(covariance)) * std::pow(cosine, 3.0));
}

SlopeTwin slope_twin_of(const Material& material) {
  const Image top = slope_moment_chain(material.normal_map->image.decoded(), Image(1, 1, 1, 0.0F)).back();
  const auto t = top.at(0, 0);
  const SlopeMoments m{{t[slope_x], t[slope_y]}, {t[slope_xx], t[slope_xy], t[slope_xy], t[slope_yy]}};
  return {m.mean, covariance(m), material.brdf.distribution, *material.lobe_parameter};
}

}  // namespace footprint::testing
