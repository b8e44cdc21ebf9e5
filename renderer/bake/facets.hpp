// Facets of a material: several lobes per facet, and the textures of its small-scale geometry (patch_facets.glsl).
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderer/bake/prefiltered.hpp"
#include "renderer/core/progress.hpp"
#include "renderer/scene/material.hpp"

namespace footprint {

/// `axis` under the shortest rotation that takes z to the unit vector `normal`; normal = -z turns about y. C++ version
/// of turnedWithNormal in facet_frame.glsl.
[[nodiscard]] glm::dvec3 turned_with_normal(const glm::dvec3& axis, const glm::dvec3& normal);

/// Weighted mean slope variance per axis of a material's lobes about their own axes, or that of its only lobe.
[[nodiscard]] double mean_lobe_variance(const Material& material);

/// The std140 members of surface_material.glsl for the effect `multi_lobe`: the number of lobes, then most_facet_lobes
/// lobes, padded with zeros. Throws Error (usage): more lobes, or parameters out of range (docs/reference/scenes.md).
[[nodiscard]] std::vector<glm::vec4> facet_lobe_block(const Material& material);

/// The value of anisotropy() in surface_material.glsl: alpha of the constant lobe along and across the direction of
/// stretch, and the direction's x and y. Without anisotropy both alphas are the lobe's.
[[nodiscard]] glm::vec4 anisotropy_of(const Material& material);

/// The strength of anisotropy, squared; 0 without any.
[[nodiscard]] float squared_strength(const Material& material);

/// The factors of a patch's paint on the material's reflection. The material already includes their mean.
struct PaintFactors {
  glm::vec3 specular{1.0F};  ///< reflectance at normal incidence
  glm::vec3 diffuse{1.0F};   ///< base colour
};

/// The factors of each paint of the material's patch; without a patch a single 1. A tabulated BRDF uses the paints
/// directly.
[[nodiscard]] std::vector<PaintFactors> paint_factors(const Material& material);

/// Textures of facets of equal area in the order of their normals, of their visibility in 1024 directions, and of a_v.
/// Without a patch, empty textures of the same names.
[[nodiscard]] std::vector<PrefilteredTexture> patch_facet_textures(const Material& material, const Progress& progress);

/// The texture of the paints' factors.
[[nodiscard]] PrefilteredTexture paint_texture(const Material& material);

/// The facets' tabulated BRDF, a layer per phi_d; one texel if the material has none.
[[nodiscard]] PrefilteredTexture tabulated_brdf_texture(const Material& material);

}  // namespace footprint
