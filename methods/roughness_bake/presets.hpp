// Engines' formulas from the mean normal's length to roughness mips, in 64 bits (baked_roughness.glsl has twins).
#pragma once

#include <array>
#include <string_view>

#include "renderer/core/options.hpp"
#include "renderer/lobes/lobe.hpp"

namespace footprint::roughness_bake {

enum class Preset {
  fit,
  filament,
  filament_rho,
  unity,
  unity_projected,
  hdrp_import,
  unreal,
  godot,
  three_removed,
  mjp_vmf,
  karis,
  order1886,
  chan2018,
  free
};

/// In the order of Preset, as users write them.
inline constexpr std::array<std::string_view, 14> preset_names{
    "fit",   "filament",      "filament_rho", "unity", "unity_projected", "hdrp_import", "unreal",
    "godot", "three_removed", "mjp_vmf",      "karis", "order1886",       "chan2018",    "free"};

/// The preset of a name. Errors: std::out_of_range if there is none.
[[nodiscard]] Preset preset_of(std::string_view name);

/// A preset, with the parameters of `free`.
struct Formula {
  Preset preset = Preset::fit;
  double constant = 2;  ///< of free: alpha'^2 = alpha^2 + min(constant / kappa, cap)
  double cap = 1;       ///< of free
};

/// The options `preset`, `constant` and `cap`. Errors (usage): a constant or cap of a preset other than `free`, because
/// results would name a preset that was not used.
[[nodiscard]] Formula formula_of(const Options& options);

/// The value that a texel stores, of which filters take means: 1 / kappa, (1 - r) / r, both at most 100, or 1 - r. Of
/// Filament 1e-4 where all normals agree. `shortfall` is 1 - r, 0 to 1, r the length of the mean normal.
[[nodiscard]] double stored_spread(Preset preset, double shortfall);

/// alpha'^2 of a lobe whose alpha^2 is twice its slope variance, over normals of the stored spread. Only `fit` depends
/// on `distribution`. alpha^2 is above 0. The result is less than alpha^2 only for `karis` and `chan2018`, whose
/// inverses are not exact, and for `unity_projected` above 1/2, where its sum saturates.
[[nodiscard]] double widened_alpha2(const Formula& formula, NormalDistribution distribution, double alpha2,
                                    double stored);

/// `fit`: the constant c(alpha) of alpha'^2 = alpha^2 + c / kappa with the least error of the NDF
/// (study/best_constant). For alpha = 0.03 (instead of 0), 0.1, 0.2, ... 1, linear between them and constant beyond.
inline constexpr std::size_t fit_points = 11;
using FitTable = std::array<double, fit_points>;
[[nodiscard]] const FitTable& fit_table(NormalDistribution distribution);

/// 1 / kappa of the mean resultant length r = 1 - q (Banerjee et al. 2005); 0 < q <= 1, infinite at 1.
[[nodiscard]] double inverse_kappa(double q);

/// 1 - r of the mean normal of a GGX lobe: r = (a - (1 - a^2) atanh a) / a^3, a^2 = 1 - alpha^2 (Chan 2018).
[[nodiscard]] double ggx_shortfall(double alpha2);

}  // namespace footprint::roughness_bake
