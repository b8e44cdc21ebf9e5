// The normal distribution as a sum of spherical Gaussians, by expectation-maximisation on the sphere.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "methods/iwasaki_sg/bvndf.hpp"
#include "methods/iwasaki_sg/spherical_gaussian.hpp"

namespace footprint::iwasaki_sg {

/// No lobe is sharper: a discretised normal stands for a lobe of this sharpness about it. A flat facet's distribution
/// is a delta function, of which a projection in the least-squares sense has no meaning.
inline constexpr double sharpest = 1e6;

/// The sharpness of the normals themselves that a lobe of the fit stands for, without the width of `sharpest`: the twin
/// of ownSharpness in iwasaki_sg_lobes.glsl.
[[nodiscard]] double own_sharpness(double sharpness);

inline constexpr int most_lobes = 16;

/// The NDF as a mixture: lobe j with the share of the area that it stands for.
struct NdfFit {
  std::vector<SphericalGaussian> lobes;  ///< 1 to the number asked for
  std::vector<double> shares;            ///< above 0, sum 1
};

/// Fits at most `count` lobes (Iwasaki 2012, Eq. 6) by the spherical EM of Han et al. 2007, section 5.2, from two
/// deterministic starts, of which the likelier is kept. Lobes so close that Eq. 8 could not tell them apart are merged
/// (condition number over 1e5), so that there may be fewer. No normals: one lobe about z.
[[nodiscard]] NdfFit fit_ndf(std::span<const WeightedNormal> normals, int count);

/// The correlation of two lobes, 0 to 1: their convolution over the geometric mean of those with themselves.
[[nodiscard]] double correlation(const SphericalGaussian& a, const SphericalGaussian& b);

}  // namespace footprint::iwasaki_sg
