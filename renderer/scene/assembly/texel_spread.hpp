// The spread of normals within a texel, beside the base BRDF.
#pragma once

#include "renderer/lobes/lobe.hpp"
#include "renderer/scene/material.hpp"

namespace footprint {

/// The effective lobe of facets with the lobe `base` whose normals follow a von Mises-Fisher distribution of
/// concentration `kappa`: s' = kappa s / (kappa + s) for exponents s (Xu et al. 2017, equations 11 to 13). The same sum
/// of variances, 1 / s' = 1 / s + 1 / kappa, holds for the kappa of `vmf`, and alpha'^2 = alpha^2 + 2 / kappa for
/// `beckmann` and `ggx`, whose alpha is at most 1. kappa: above 0.
[[nodiscard]] Lobe convolved(const Lobe& base, double kappa);

/// Replaces the lobe of each texel by its effective lobe. The finer of both grids stays, with the nearest texel of the
/// other.
/// kappa: 1 channel, above 0.
/// Throws Error (usage): the material has several lobes, or a map of their width with other coordinates.
void spread_normals(const TextureMap& kappa, Material& material);

}  // namespace footprint
