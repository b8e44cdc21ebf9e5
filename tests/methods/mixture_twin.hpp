// Test support for `tan_gmm`: the mixture of a filtered texel in double precision, as in tan_gmm.glsl, with integrals
// instead of the shader's approximations.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <span>
#include <vector>

namespace footprint::tan_gmm {

/// A Gaussian over the disc; `spread` is the normals' variance per axis.
struct Recovered {
  double share = 0, x = 0, y = 0, spread = 0;
};

/// The Gaussian of a filtered texel (alpha, alpha mu, alpha second moment) of one component.
inline Recovered recovered(const glm::dvec4& t, bool corrected = true) {
  if (t.x < 1e-4) return {};
  const double x = t.y / t.x;
  const double y = t.z / t.x;
  const double spread = std::max(t.w / t.x - x * x - y * y, 0.0);
  return {t.x, x, y, corrected ? 0.5 * spread : spread};
}

/// All components of a texel, with shares that sum to 1.
inline std::vector<Recovered> recovered_mixture(std::span<const glm::dvec4> texels, bool corrected = true) {
  std::vector<Recovered> mixture;
  double total = 0;
  for (const glm::dvec4& texel : texels) {
    mixture.push_back(recovered(texel, corrected));
    total += mixture.back().share;
  }
  for (Recovered& r : mixture) r.share /= total;
  return mixture;
}

inline double height_over(const Recovered& r) { return std::sqrt(std::max(1.0 - r.x * r.x - r.y * r.y, 0.0)); }

/// The variance of normals and base lobe together, per axis of the disc.
inline double variance_over_disc(const Recovered& r, double base) {
  return std::max(r.spread + base * std::min(std::max(height_over(r), std::sqrt(base)), 1.0), 1e-6);
}

/// The mass of a Gaussian inside the disc, by the midpoint rule in polar coordinates about the disc's centre.
inline double mass_in_disc(const Recovered& r, double variance) {
  constexpr int rings = 400;
  constexpr int sectors = 720;
  double sum = 0;
  for (int i = 0; i < rings; ++i) {
    const double radius = (i + 0.5) / rings;
    for (int j = 0; j < sectors; ++j) {
      const double angle = (j + 0.5) * 2.0 * std::numbers::pi / sectors;
      const double dx = radius * std::cos(angle) - r.x;
      const double dy = radius * std::sin(angle) - r.y;
      sum += radius * std::exp(-0.5 * (dx * dx + dy * dy) / variance);
    }
  }
  return sum / (rings * sectors * variance);
}

/// The factor on a component that extends beyond the disc's rim; 1 for others.
inline double rim_factor(const Recovered& r, double base) {
  const double variance = variance_over_disc(r, base);
  if (1.0 - std::hypot(r.x, r.y) > 4.0 * std::sqrt(variance)) return 1.0;
  const double above = 0.5 * std::erfc(-std::asin(height_over(r)) / std::sqrt(2.0 * base));
  return above / std::max(mass_in_disc(r, variance), 1e-3);
}

/// The effective NDF per solid angle, for a base lobe of variance `base`, without the rim's factor.
inline double ndf_cut_at_rim(std::span<const Recovered> mixture, double base, const glm::dvec3& h) {
  double sum = 0;
  for (const Recovered& r : mixture) {
    const double variance = variance_over_disc(r, base);
    const double d2 = (h.x - r.x) * (h.x - r.x) + (h.y - r.y) * (h.y - r.y);
    sum += r.share * std::exp(-0.5 * d2 / variance) / (2.0 * std::numbers::pi * variance);
  }
  return sum * std::max(h.z, 0.0);
}

}  // namespace footprint::tan_gmm
