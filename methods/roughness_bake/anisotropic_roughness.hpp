// Roughness with a direction, as KHR_materials_anisotropy stores it, from the covariance of slopes.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderer/image/image.hpp"
#include "renderer/scene/material.hpp"

namespace footprint::roughness_bake {

/// A lobe of KHR_materials_anisotropy: alpha is roughness^2 across the direction, and mix(alpha, 1, strength^2) along.
struct DirectedRoughness {
  glm::dvec2 direction{1.0, 0.0};  ///< in the tangent plane, unit; its opposite is the same
  double strength = 0.0, roughness = 1.0;
};

/// The lobe whose squared widths are alpha2 plus twice the covariance of slopes about the normal; none is wider than 1.
[[nodiscard]] DirectedRoughness directed_roughness(const glm::dmat2& covariance, double alpha2);

/// The covariance of slopes about their mean, seen from the normal of the mean slope (common_slopes.glsl, Jacobian).
[[nodiscard]] glm::dmat2 covariance_about(const glm::dvec2& mean, const glm::dmat2& covariance);

/// The lobe at every texel of every level, 4 channels from 0 to 1: (direction + 1) / 2, strength, roughness. Directions
/// have the sign that is closest to the direction of the coarsest level, so that texture filters can blend them.
/// Throws Error (usage): one roughness map cannot store the material's maps, or its lobe is neither GGX nor Beckmann.
[[nodiscard]] std::vector<Image> directed_chain(const Material& material);

}  // namespace footprint::roughness_bake
