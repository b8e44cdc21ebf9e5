// The table of one material that the shader needs: its settings from the options, and the stages from a patch to
// amplitudes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "methods/iwasaki_sg/amplitudes.hpp"
#include "methods/iwasaki_sg/bvndf.hpp"
#include "methods/iwasaki_sg/ndf_fit.hpp"
#include "renderer/core/options.hpp"
#include "renderer/core/progress.hpp"
#include "renderer/effects/effects.hpp"
#include "renderer/microgeometry/patch.hpp"
#include "renderer/scene/material.hpp"

namespace footprint::iwasaki_sg {

/// The options of the method.
[[nodiscard]] std::vector<OptionSpec> option_table();

/// Whether the facets have a BRDF of their own, in a table.
[[nodiscard]] bool is_tabulated(const Material& material);

/// The effects of small-scale geometry that a material calls for by itself.
[[nodiscard]] EffectSet patch_effects(const Material& material);

struct TableSettings {
  int lobes = 8;                ///< at most; 1 to `most_lobes`
  int side = 12;                ///< of the grid of directions: 12 for the paper's 144
  std::size_t facets = 65'536;  ///< samples of the patch
  std::uint64_t seed = 1;
  Cosines cosines = Cosines::base;
  Energy energy = Energy::conserved;
  std::size_t channels = 1;            ///< 3 in colour
  std::vector<PaintFactors> paints{};  ///< of each paint of the patch
};

/// The settings of a material's table by the options of the method. `effects`: those of the scene.
[[nodiscard]] TableSettings table_settings(const Material& material, const Options& options, const EffectSet& effects);

struct MaterialTable {
  Amplitudes amplitudes;
  std::vector<double> shares;  ///< of each lobe in what is seen from straight above; sum 1
  std::size_t normals = 0;     ///< discretised normals that facets have
  double visible_share = 1.0;  ///< of the patch's area that any direction sees
};

/// The BVNDF of a patch (check_patch holds). Reports its stages as they begin: samples, visibility, BVNDF.
[[nodiscard]] Bvndf patch_bvndf(const Patch& patch, const TableSettings& settings, const Progress& progress);

/// The table of a patch. Reports its stages as they begin: samples, visibility, NDF, BVNDF (before
/// and after the NDF, whose lobes its sums need), amplitudes.
[[nodiscard]] MaterialTable patch_table(const Patch& patch, const TableSettings& settings, const Progress& progress);

/// The table of facets that are all seen from everywhere and weigh the same whatever their tilt: those of a normal map.
/// `normals` have weights that sum to 1.
[[nodiscard]] MaterialTable flat_table(std::span<const WeightedNormal> normals, const TableSettings& settings);

}  // namespace footprint::iwasaki_sg
