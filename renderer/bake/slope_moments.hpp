// Slope moments: the mean and covariance of slopes b = -n_xy / n_z, which the LEAN family of methods bakes.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderer/bake/prefiltered.hpp"
#include "renderer/core/options.hpp"
#include "renderer/effects/effects.hpp"
#include "renderer/image/image.hpp"
#include "renderer/scene/material.hpp"

namespace footprint {

/// First and second moments of slope over a footprint. Both are averages over area, so texture filters apply.
struct SlopeMoments {
  glm::dvec2 mean{0.0};    ///< B = E[b]
  glm::dmat2 second{0.0};  ///< M = E[b b^T]
};

/// The default limit of slopes, reached at n_z = 0.02: slopes have a pole at the horizon.
inline constexpr double steepest_slope = 50.0;

/// The slope b = -n_xy / n_z of a unit normal (Olano and Baker 2010), shortened to `steepest`. n_z below 0.02 counts as
/// 0.02, also if negative.
[[nodiscard]] glm::dvec2 slope_of(const glm::dvec3& normal, double steepest = steepest_slope);

/// Combines the moments of two bump layers (Olano and Baker 2010, section 4). Slopes of independent layers add, and so
/// do their means and covariances: M = Ma + Mb + Ba Bb^T + Bb Ba^T.
[[nodiscard]] SlopeMoments layered(const SlopeMoments& a, const SlopeMoments& b);

/// The covariance M - B B^T. Rounding can make an eigenvalue negative; the nearest positive semidefinite matrix
/// replaces it. Matches slopeCovariance in common_slopes.glsl.
[[nodiscard]] glm::dmat2 covariance(const SlopeMoments& moments);

/// The channels of slope_moment_chain.
inline constexpr int slope_x = 0, slope_y = 1, slope_xx = 2, slope_xy = 3, slope_yy = 4;

/// The mip chain of B and M, 5 channels.
/// `normals`: RGBA, of any length above 0, with a weight in alpha; weight 0 leaves the means unchanged.
/// `variance`: slope variance per axis that is added to M before filtering (base roughness). One channel, of the size
/// of the normals or 1 x 1; another size throws Error (usage).
/// `steepest`: the limit of slopes.
/// `stretch`: of the base lobe, whose round mean has `variance` (stretch_map_of); two channels, of the size of
/// `variance` or 1 x 1.
[[nodiscard]] std::vector<Image> slope_moment_chain(const Image& normals, const Image& variance,
                                                    double steepest = steepest_slope,
                                                    const Image& stretch = Image(1, 1, 2, 0.0F));

/// Copies some channels of every level, in the given order.
[[nodiscard]] std::vector<Image> channels_of(const std::vector<Image>& chain, const std::vector<int>& channels);

/// `roughness=stretched|shading|moments`: where the base lobe is added to the slopes, and its shape there.
[[nodiscard]] OptionSpec slope_roughness_option();

/// `steepest=S`: limits slopes, because one texel at the horizon would outweigh thousands of others.
[[nodiscard]] OptionSpec steepest_slope_option();

/// `variant=lean|clean`: the full covariance, or its trace.
[[nodiscard]] OptionSpec slope_variant_option();

/// Stores the full covariance or, as CLEAN does, only its trace.
enum class SlopeVariant { full, scalar };

/// The moments that a method stores. `mean_normal`: also the mean of the unit normals, not renormalised.
/// `lobe_variance`: also the base lobe's slope variance, unless the moments include it.
struct StoredSlopes {
  SlopeVariant variant = SlopeVariant::full;
  bool mean_normal = false;
  bool lobe_variance = true;
};

/// The textures that footprint_slopes.glsl reads, for options with the three specs above.
/// If normals vary: `slope_moments` has (Bx, By, Mxx, Myy), or (Bx, By, Mxx + Myy) for the scalar variant.
/// `slope_rest`, of the same size, has Mxy (full variant) and the mean normal if stored; without either it is omitted.
/// `layer_moments` and `layer_rest` describe a bump layer in the same way, without a normal.
/// `lobe_variance` (bake_lobe_variance) is present if it is stored, the roughness varies and is not part of the
/// moments. A note counts the texels that are steeper than `steepest`. Throws Error (usage) if roughness=moments is
/// combined with maps of different sizes or coordinates.
[[nodiscard]] Prefiltered bake_slopes(const Material& material, const Options& options, const EffectSet& effects,
                                      const StoredSlopes& stored);

}  // namespace footprint
