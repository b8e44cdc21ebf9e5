// Moments of slope, for methods that represent a normal map by slopes b = -n_xy / n_z with a mean and a covariance.
#pragma once

#include <glm/glm.hpp>
#include <initializer_list>
#include <vector>

#include "renderer/bake/prefiltered.hpp"
#include "renderer/core/options.hpp"
#include "renderer/effects/effects.hpp"
#include "renderer/image/image.hpp"
#include "renderer/scene/material.hpp"

namespace footprint {

/// First and second moments of slope over a footprint. Both are linear in area and filter as any texture does.
struct SlopeMoments {
  glm::dvec2 mean{0.0};    ///< B = E[b]
  glm::dmat2 second{0.0};  ///< M = E[b b^T]
};

/// The steepest slope of any normal, at n_z <= 0.02, because slopes have a pole at the horizon.
inline constexpr double steepest_slope = 50.0;

/// b = -n_xy / n_z of a unit normal (Olano and Baker 2010), limited to the length `steepest`. n_z below 0.02, also
/// negative, counts as 0.02.
[[nodiscard]] glm::dvec2 slope_of(const glm::dvec3& normal, double steepest = steepest_slope);

/// The moments of a bump layer on top of another. Slopes of independent layers add, and so do their means and
/// covariances: M = Ma + Mb + Ba Bb^T + Bb Ba^T (Olano and Baker 2010, section 4: layers combine in the shader).
[[nodiscard]] SlopeMoments layered(const SlopeMoments& a, const SlopeMoments& b);

/// M - B B^T as the nearest matrix without a negative eigenvalue; with equal normals rounding decides the sign. The
/// twin of slopeCovariance in common_slopes.glsl.
[[nodiscard]] glm::dmat2 covariance(const SlopeMoments& moments);

/// The channels of slope_moment_chain.
inline constexpr int slope_x = 0, slope_y = 1, slope_xx = 2, slope_xy = 3, slope_yy = 4;

/// The mip chain of B and M, 5 channels, of RGBA normals of any length above 0. Normals of weight 0 in alpha are left
/// out of the means. `variance`, one channel of the normals' size or 1 x 1, is slope variance per axis that is added to
/// M before filtering: base roughness in the moments. Slopes are limited to `steepest`. Errors (usage): `variance` has
/// another size.
[[nodiscard]] std::vector<Image> slope_moment_chain(const Image& normals, const Image& variance,
                                                    double steepest = steepest_slope);

/// The given channels of every level, in the given order.
[[nodiscard]] std::vector<Image> channels_of(const std::vector<Image>& chain, std::initializer_list<int> channels);

/// `roughness=stretched|shading|moments`: how the base lobe is combined with the slopes.
[[nodiscard]] OptionSpec slope_roughness_option();

/// `steepest=S`. Without a limit one texel at the horizon, where slopes have a pole, would outweigh thousands.
[[nodiscard]] OptionSpec steepest_slope_option();

/// Whether the full covariance is stored or, as in CLEAN, only its trace.
enum class SlopeVariant { full, scalar };

/// The moments that a method stores. `mean_normal`: also the mean of the unit normals, not renormalised.
struct KeptSlopes {
  SlopeVariant variant = SlopeVariant::full;
  bool mean_normal = false;
};

/// The textures that footprint_slopes.glsl reads, for options with the three specs above. If normals vary:
/// `slope_moments` (Bx, By, Mxx, Myy; scalar: Bx, By, Mxx + Myy) and, of the same size, `slope_rest` with Mxy (not
/// scalar) and then the mean normal if it is stored; no `slope_rest` without either. Also `layer_moments` and
/// `layer_rest` of a bump layer, without a normal. `lobe_variance` (bake_lobe_variance) if the roughness varies and is
/// not in the moments. A note counts the texels that are steeper than `steepest`. Errors (usage): roughness in the
/// moments of maps that differ in size or coordinates.
[[nodiscard]] Prefiltered bake_slopes(const Material& material, const Options& options, const EffectSet& effects,
                                      const KeptSlopes& kept);

}  // namespace footprint
