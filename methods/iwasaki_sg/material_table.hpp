// The table of one material: its settings from the options, the stages from a patch to amplitudes, and its textures.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "methods/iwasaki_sg/bvndf.hpp"
#include "methods/iwasaki_sg/lobe_fit.hpp"
#include "renderer/bake/prefiltered.hpp"
#include "renderer/core/options.hpp"
#include "renderer/core/progress.hpp"
#include "renderer/effects/effects.hpp"
#include "renderer/microgeometry/patch.hpp"
#include "renderer/scene/material.hpp"

namespace footprint::iwasaki_sg {

/// The options of the method.
[[nodiscard]] std::vector<OptionSpec> option_table();

/// Whether the facets have a tabulated BRDF.
[[nodiscard]] bool is_tabulated(const Material& material);

/// The effects of small-scale geometry that a material has.
[[nodiscard]] EffectSet patch_effects(const Material& material);

struct TableSettings {
  int lobes = 8;                ///< the most lobes; 1 to `most_lobes`
  int side = 12;                ///< of the grid of directions; 12 for the paper's 144
  std::size_t facets = 65'536;  ///< samples of the patch
  std::uint64_t seed = 1;
  Cosines cosines = Cosines::base;
  Energy energy = Energy::conserved;
  std::size_t channels = 1;            ///< 3 in colour
  std::vector<PaintFactors> paints{};  ///< factors of each paint of the patch
};

/// The settings of a material's table by the options of the method. `effects`: those of the scene.
[[nodiscard]] TableSettings table_settings(const Material& material, const Options& options, const EffectSet& effects);

struct MaterialTable {
  Amplitudes amplitudes;
  std::vector<double> shares;  ///< of each lobe in the area visible from above; sum 1
  std::size_t normals = 0;     ///< number of discretised normals with facets
  double visible_share = 1.0;  ///< of the patch's area that is visible from any direction
};

/// The BVNDF of a patch that passes check_patch. Reports its stages as they begin: samples, visibility, BVNDF.
[[nodiscard]] Bvndf patch_bvndf(const Patch& patch, const TableSettings& settings, const Progress& progress);

/// The table of a patch. Reports its stages as they begin: samples, visibility, BVNDF, NDF, BVNDF again (its sums need
/// the lobes of the NDF), amplitudes.
[[nodiscard]] MaterialTable patch_table(const Patch& patch, const TableSettings& settings, const Progress& progress);

/// The table of a normal map, whose facets are visible from everywhere and have equal weights at any tilt. `normals`
/// have weights that sum to 1.
[[nodiscard]] MaterialTable flat_table(std::span<const WeightedNormal> normals, const TableSettings& settings);

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
