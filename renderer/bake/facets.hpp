// Facets of a material: several lobes per facet, and the textures of its small-scale geometry (patch_facets.glsl).
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderer/bake/prefiltered.hpp"
#include "renderer/core/progress.hpp"
#include "renderer/scene/material.hpp"

namespace footprint {

/// The shortest rotation that takes z to the unit vector `normal`, of `axis`; normal = -z turns about y. The twin of
/// turnedWithNormal in facet_frame.glsl.
[[nodiscard]] glm::dvec3 turned_with_normal(const glm::dvec3& axis, const glm::dvec3& normal);

/// Slope variance per axis of a material's lobes about their own axes, by weight; of the one lobe about the normal
/// where it has no others.
[[nodiscard]] double mean_lobe_variance(const Material& material);

/// The std140 members of surface_material.glsl that the effect `multi_lobe` adds: the number of lobes, then all
/// most_facet_lobes, those that a material lacks as zeros. Throws Error (usage): more lobes than that, or one that is
/// no lobe (docs/scenes.md has the ranges).
[[nodiscard]] std::vector<glm::vec4> facet_lobe_block(const Material& material);

/// What a paint of a patch multiplies what the material reflects by. Its mean over the patch is in the material
/// already.
struct PaintFactors {
  glm::vec3 specular{1.0F};  ///< reflectance at normal incidence
  glm::vec3 diffuse{1.0F};   ///< base colour
};

/// One for each paint of the material's patch; one of 1 where it has none. A tabulated BRDF takes the paints as they
/// are.
[[nodiscard]] std::vector<PaintFactors> paint_factors(const Material& material);

/// Facets of equal area in the order of their normals, what each sees of 1024 directions, and a_v. Of a material
/// without a patch: textures of the same names that hold nothing.
[[nodiscard]] std::vector<PrefilteredTexture> patch_facet_textures(const Material& material, const Progress& progress);

/// The paints' factors.
[[nodiscard]] PrefilteredTexture paint_texture(const Material& material);

/// The facets' tabulated BRDF, a layer for each phi_d; one texel where the material has none.
[[nodiscard]] PrefilteredTexture tabulated_brdf_texture(const Material& material);

}  // namespace footprint
