// Base lobes that are wider along one direction of the facet's tangent plane.
#pragma once

#include <glm/glm.hpp>

#include "renderer/lobes/lobe.hpp"

namespace footprint {

/// How a lobe is stretched (KHR_materials_anisotropy).
struct Anisotropy {
  float strength = 0.0F;  ///< 0..1; 0 is round
  float rotation = 0.0F;  ///< of the direction of stretch, radians from the tangent towards the bitangent

  friend bool operator==(const Anisotropy&, const Anisotropy&) = default;
};

/// The widths of an anisotropic Beckmann or GGX lobe, along and across the direction of stretch.
struct Alphas {
  double along, across;

  friend bool operator==(const Alphas&, const Alphas&) = default;
};

/// alpha across and mix(alpha, 1, strength^2) along, as KHR_materials_anisotropy defines them.
/// strength: 0..1. alpha: that of the roughness, `smallest_alpha` to 1.
[[nodiscard]] Alphas anisotropic_alphas(double strength, double alpha);

/// The round lobe with the mean slope variance of both directions: alpha^2 is the mean of both squares.
[[nodiscard]] double round_alpha(const Alphas& alphas);

/// The inverse of round_alpha for one strength: a map of round lobes has the anisotropic ones in it. Matches
/// facetAlphas in anisotropic_facets.glsl. round: alpha of the round lobe; smaller ones than the strength allows give
/// `smallest_alpha` across.
[[nodiscard]] Alphas alphas_of_round(double strength, double round);

/// The density of normals of an anisotropic facet, 1/sr (Heitz 2014, section 5). Matches baseDensity in
/// anisotropic_facets.glsl.
/// distribution: beckmann or ggx. rotation: as in Anisotropy.
/// own: unit half vector in the facet's frame, z along its normal (turned_with_normal).
[[nodiscard]] double anisotropic_density(NormalDistribution distribution, const Alphas& alphas, double rotation,
                                         const glm::dvec3& own);

}  // namespace footprint
