// The lobe of stretched_part.glsl once more, in doubles and by another road: normals and directions through the
// projection's inverse, the inverse root by eigenvectors, the base lobe from vectors.
#pragma once

#include <cmath>
#include <glm/glm.hpp>

#include "renderer/scene/material.hpp"
#include "tests/support/slope_twin.hpp"

namespace footprint::testing {

/// Share, mean and covariance of a part of the normals in stereographic coordinates.
struct PartTwin {
  double share = 0.0;
  glm::dvec2 mean{0.0};
  glm::dmat2 spread{0.0};

  static glm::dvec3 unprojected(const glm::dvec2& p) {
    const double q = glm::dot(p, p);
    return glm::dvec3(2.0 * p, 1.0 - q) / (1.0 + q);
  }
  static glm::dmat2 inverse_root(const glm::dmat2& m) {
    const double angle = 0.5 * std::atan2(2.0 * m[0][1], m[0][0] - m[1][1]);
    const glm::dmat2 turn(std::cos(angle), std::sin(angle), -std::sin(angle), std::cos(angle));
    const glm::dmat2 diagonal = glm::transpose(turn) * m * turn;
    return turn * glm::dmat2(1.0 / std::sqrt(diagonal[0][0]), 0, 0, 1.0 / std::sqrt(diagonal[1][1])) *
           glm::transpose(turn);
  }

  // The energy of a GGX lobe over that which is left within the angle that the stretch takes to the horizon, by the
  // midpoint rule.
  static double given_back(double alpha, double s) {
    constexpr int steps = 20000;
    double all = 0.0;
    double within = 0.0;
    for (int i = 0; i < steps; ++i) {
      const double c = (i + 0.5) / steps;
      const double d = 1.0 - (1.0 - alpha * alpha) * c * c;
      const double mass = 2.0 * alpha * alpha / (d * d) / steps;
      all += mass;
      if (c > (s - 1.0) / (s + 1.0)) within += mass;
    }
    return all / within;
  }

  [[nodiscard]] double density(NormalDistribution distribution, double lobe, const glm::dvec3& h) const {
    const glm::dvec3 axis = unprojected(mean);
    const double v = lobe_variance({distribution, static_cast<float>(lobe)});
    const double shrunk = 1.0 / (1.0 + axis.z);  // of a tangent at the axis, projected
    const glm::dmat2 a = inverse_root(glm::dmat2(1.0) + spread / (v * shrunk * shrunk));
    const glm::dvec2 at = glm::dvec2(h) / (1.0 + h.z);
    const glm::dvec3 base = unprojected(mean + a * (at - mean));
    const double areas = std::pow((1.0 + base.z) / (1.0 + h.z), 2.0);
    return share * base_density(distribution, lobe, axis, base) * glm::determinant(a) * areas *
           (distribution == NormalDistribution::ggx ? given_back(lobe, 1.0 / glm::determinant(a)) : 1.0);
  }
};

}  // namespace footprint::testing
