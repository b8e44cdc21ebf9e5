// Moments of slope: what methods bake that see a normal map as slopes b = -n_xy / n_z with a mean and a covariance.
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

/// First and second moments of slope over a footprint, both linear in area: they filter as any texture does.
struct SlopeMoments {
  glm::dvec2 mean{0.0};    ///< B = E[b]
  glm::dmat2 second{0.0};  ///< M = E[b b^T]
};

/// The steepest slope that a normal is given, at n_z <= 0.02: slopes have a pole at the horizon.
inline constexpr double steepest_slope = 50.0;

/// b = -n_xy / n_z of a unit normal (Olano and Baker 2010), in its direction no longer than `steepest`; n_z below 0.02,
/// negative too, counts as 0.02.
[[nodiscard]] glm::dvec2 slope_of(const glm::dvec3& normal, double steepest = steepest_slope);

/// The moments of a bump layer on top of another: the slopes of independent layers add, so their means and covariances
/// do, M = Ma + Mb + Ba Bb^T + Bb Ba^T (Olano and Baker 2010, section 4: layers combine in the shader).
[[nodiscard]] SlopeMoments layered(const SlopeMoments& a, const SlopeMoments& b);

/// M - B B^T, as the nearest matrix without a negative eigenvalue: with equal normals rounding decides the sign. The
/// twin of slopeCovariance in common_slopes.glsl.
[[nodiscard]] glm::dmat2 covariance(const SlopeMoments& moments);

/// The channels of slope_moment_chain.
inline constexpr int slope_x = 0, slope_y = 1, slope_xx = 2, slope_xy = 3, slope_yy = 4;

/// The mip chain of B and M, 5 channels, of RGBA normals (any length above 0, weight in alpha; weight 0 leaves the
/// means untouched). `variance`, one channel of the normals' size or 1 x 1, is slope variance per axis that joins M
/// before it is filtered: base roughness in the moments. Slopes are no longer than `steepest`. Errors (usage): another
/// size.
[[nodiscard]] std::vector<Image> slope_moment_chain(const Image& normals, const Image& variance,
                                                    double steepest = steepest_slope);

/// The given channels of every level, in the given order.
[[nodiscard]] std::vector<Image> channels_of(const std::vector<Image>& chain, std::initializer_list<int> channels);

/// `roughness=stretched|shading|moments`: where the base lobe joins the slopes, and what shape it has there.
[[nodiscard]] OptionSpec slope_roughness_option();

/// `steepest=S`: one texel at the horizon, where slopes have a pole, would otherwise outweigh thousands.
[[nodiscard]] OptionSpec steepest_slope_option();

/// Whether the whole covariance is kept or, as CLEAN has it, its trace alone.
enum class SlopeVariant { full, scalar };

/// What a method keeps of a normal map. `mean_normal`: the mean of the unit normals too, not renormalised.
struct KeptSlopes {
  SlopeVariant variant = SlopeVariant::full;
  bool mean_normal = false;
};

/// The textures that footprint_slopes.glsl reads, for options with the three specs above, where normals vary:
/// `slope_moments` (Bx, By, Mxx, Myy; scalar: Bx, By, Mxx + Myy) and, of the same size, `slope_rest`, what that has no
/// room for: Mxy (not scalar), then the mean normal where it is kept; neither: there is no such texture. Likewise
/// `layer_moments` and `layer_rest` of a bump layer, without a normal. `lobe_variance` (bake_lobe_variance) where the
/// roughness varies and the moments do not hold it. Errors (usage): roughness in the moments of maps that differ in
/// size or coordinates. Texels that are steeper than `steepest` are counted in a note.
[[nodiscard]] Prefiltered bake_slopes(const Material& material, const Options& options, const EffectSet& effects,
                                      const KeptSlopes& kept);

}  // namespace footprint
