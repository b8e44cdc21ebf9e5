// The facets of a material's patch as textures: what the reference of small-scale geometry reads (patch_facets.glsl).
#pragma once

#include <vector>

#include "renderer/bake/prefiltered.hpp"
#include "renderer/core/progress.hpp"
#include "renderer/scene/material.hpp"

namespace footprint {

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
