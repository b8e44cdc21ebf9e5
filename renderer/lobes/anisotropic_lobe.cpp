// Closed forms in double precision.
#include "renderer/lobes/anisotropic_lobe.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace footprint {

Alphas anisotropic_alphas(double strength, double alpha) {
  return {alpha + (1.0 - alpha) * strength * strength, alpha};
}

double round_alpha(const Alphas& alphas) {
  return std::sqrt(0.5 * (alphas.along * alphas.along + alphas.across * alphas.across));
}

Alphas alphas_of_round(double strength, double round) {
  // along = q + p across in along^2 + across^2 = 2 round^2.
  const double q = strength * strength, p = 1.0 - q;
  const double norm = 1.0 + p * p;
  const double across = (std::sqrt(std::max(2.0 * norm * round * round - q * q, 0.0)) - p * q) / norm;
  return anisotropic_alphas(strength, std::max(across, smallest_alpha));
}

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
