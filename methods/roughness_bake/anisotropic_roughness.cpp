// The eigenvectors of a symmetric 2 x 2 matrix, at every texel of LEAN's moments.
#include "methods/roughness_bake/roughness_bake.hpp"

#include <algorithm>
#include <cmath>

#include "renderer/bake/material_maps.hpp"
#include "renderer/bake/slope_moments.hpp"
#include "renderer/core/error.hpp"

namespace footprint::roughness_bake {
namespace {

constexpr double steepest = 3.0;  // as lean's default (methods/lean/README.md)

SlopeMoments moments_at(const Image& level, std::size_t texel) {
  const float* const m = &level.texels[static_cast<std::size_t>(level.channels) * texel];
  return {.mean = {m[slope_x], m[slope_y]}, .second = glm::dmat2(m[slope_xx], m[slope_xy], m[slope_xy], m[slope_yy])};
}

DirectedRoughness lobe_at(const Material& material, const Image& moments, const Image& rough, std::size_t texel) {
  const bool varies = width_map(material) != nullptr;
  const float r = rough.texels[texel];
  const Lobe base = varies ? lobe_from_alpha(material.brdf.distribution, r * r) : lobe_of(material);
  const SlopeMoments slopes = moments_at(moments, texel);
  return directed_roughness(covariance_about(slopes.mean, covariance(slopes)), 2.0 * lobe_variance(base));
}

void require_two_widths(const Material& material) {
  const NormalDistribution distribution = material.brdf.distribution;
  if (distribution == NormalDistribution::ggx || distribution == NormalDistribution::beckmann) return;
  throw Error(ErrorKind::usage, "anisotropic=on", "the lobe of the base BRDF has one width, whatever the direction",
              "use anisotropic=off, or a scene with GGX or Beckmann");
}

}  // namespace

DirectedRoughness directed_roughness(const glm::dmat2& covariance, double alpha2) {
  const glm::dvec2 deviator(0.5 * (covariance[0][0] - covariance[1][1]), covariance[0][1]);
  const double middle = 0.5 * (covariance[0][0] + covariance[1][1]), radius = glm::length(deviator);
  const auto alpha = [&](double variance) {
    return std::clamp(std::sqrt(alpha2 + 2.0 * std::max(variance, 0.0)), smallest_alpha, 1.0);
  };
  const double along = alpha(middle + radius), across = alpha(middle - radius);
  const double angle = 0.5 * std::atan2(deviator.y, deviator.x);
  return {.direction = {std::cos(angle), std::sin(angle)},
          .strength = across < 1.0 ? std::sqrt((along - across) / (1.0 - across)) : 0.0,
          .roughness = std::sqrt(across)};
}

glm::dmat2 covariance_about(const glm::dvec2& mean, const glm::dmat2& covariance) {
  const double q = std::sqrt(1.0 + glm::dot(mean, mean));
  const glm::dmat2 inverse = glm::dmat2(1.0 / q) - glm::outerProduct(mean, mean) / (q * q * (q + 1.0));
  return inverse * covariance * inverse;
}

std::vector<Image> directed_chain(const Material& material) {
  require_two_widths(material);
  const CommonLevels levels =
      common_levels(material, slope_moment_chain(normal_map_of(material), Image(1, 1, 1, 0.0F), steepest));
  const glm::dvec2 common = lobe_at(material, levels.normals.back(), levels.rough.back(), 0).direction;
  std::vector<Image> chain;
  for (std::size_t level = 0; level < levels.rough.size(); ++level) {
    const Image& rough = levels.rough[level];
    Image& out = chain.emplace_back(rough.width, rough.height, 4);
    for (std::size_t i = 0; i < out.texel_count(); ++i) {
      const DirectedRoughness lobe = lobe_at(material, levels.normals[level], rough, i);
      const glm::dvec2 d = lobe.direction * (glm::dot(lobe.direction, common) < 0.0 ? -0.5 : 0.5) + 0.5;
      const glm::dvec4 texel(d, lobe.strength, lobe.roughness);
      for (int c = 0; c < 4; ++c) out.texels[4 * i + static_cast<std::size_t>(c)] = static_cast<float>(texel[c]);
    }
  }
  return chain;
}

}  // namespace footprint::roughness_bake
