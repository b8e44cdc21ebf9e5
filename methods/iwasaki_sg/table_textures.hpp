// The textures of a material's table.
#pragma once

#include "renderer/bake/prefiltered.hpp"
#include "renderer/core/options.hpp"
#include "renderer/core/progress.hpp"
#include "renderer/effects/effects.hpp"
#include "renderer/scene/material.hpp"

namespace footprint::iwasaki_sg {

/// Bakes a material: `iwasaki_lobes` (axes, sharpnesses, shares), `iwasaki_amplitudes` (tiles of wo, texels of wi) and,
/// by options and effects, `iwasaki_diffuse` (the diffuse term under an environment), `iwasaki_brdf`, `iwasaki_table`
/// and `iwasaki_rise` (the lobes of the facets' own BRDF, and their factor by difference angle).
[[nodiscard]] Prefiltered baked_material(const Material& material, const Options& options, const EffectSet& effects,
                                         const Progress& progress);

/// The bake of a material after its base BRDF changed. Visibility, normals and their amplitudes stay, because they do
/// not depend on it (Iwasaki et al. 2012): only the lobes of the BRDF are made again. before: its bake with the same
/// options and effects.
[[nodiscard]] Prefiltered with_other_brdf(const Prefiltered& before, const Material& material, const Options& options,
                                          const EffectSet& effects);

}  // namespace footprint::iwasaki_sg
