// The two fits of lobes: the normal distribution as a sum of spherical Gaussians, by expectation-maximisation on the
// sphere, and their amplitudes mu_j(wi, wo), by a least-squares projection of the BVNDF for each pair of directions.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "methods/iwasaki_sg/bvndf.hpp"
#include "methods/iwasaki_sg/spherical_gaussian.hpp"
#include "renderer/bake/prefiltered.hpp"
#include "renderer/scene/environment.hpp"

namespace footprint::iwasaki_sg {

/// The sharpness of the sharpest lobe. A discretised normal is represented by a lobe of this sharpness, because the
/// distribution of a flat facet is a delta function, which has no least-squares projection.
inline constexpr double sharpest = 1e6;

/// The sharpness of the normals that a lobe of the fit represents, without the width of `sharpest`. The twin of
/// ownSharpness in iwasaki_sg_lobes.glsl.
[[nodiscard]] double own_sharpness(double sharpness);

inline constexpr int most_lobes = 16;

/// The NDF as a mixture of lobes with their shares of the area.
struct NdfFit {
  std::vector<SphericalGaussian> lobes;  ///< 1 to the requested number
  std::vector<double> shares;            ///< above 0, sum 1
};

/// Fits at most `count` lobes (Iwasaki 2012, Eq. 6) by the spherical EM of Han et al. 2007, section 5.2. Keeps the
/// likelier result of two deterministic starts. Merges lobes that are too close for Eq. 8 (condition number over 1e5).
/// Without normals: one lobe about z.
[[nodiscard]] NdfFit fit_ndf(std::span<const WeightedNormal> normals, int count);

/// The correlation of two lobes, 0 to 1: their convolution divided by the geometric mean of their convolutions with
/// themselves.
[[nodiscard]] double correlation(const SphericalGaussian& a, const SphericalGaussian& b);

/// A small matrix or vector on the stack.
using LobeMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_lobes, most_lobes>;
using LobeVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_lobes, 1>;

/// A of Eq. 8 scaled to a unit diagonal: the correlations of the lobes.
[[nodiscard]] LobeMatrix correlations(std::span<const SphericalGaussian> lobes);

/// The x >= 0 that minimises x.(A x) / 2 - b.x for a positive definite A, by active sets on the normal equations
/// (Lawson and Hanson 1974, chapter 23; Bro and De Jong 1997).
[[nodiscard]] LobeVector solve_non_negative(const LobeMatrix& a, const LobeVector& b);

/// The values of a material's table. `masses` are the amplitudes times the integrals of their lobes (`integral`): 0 to
/// about 1, while amplitudes reach 1e5.
struct Amplitudes {
  std::vector<SphericalGaussian> lobes;
  std::size_t directions = 0, channels = 1;
  std::vector<float> masses;   ///< [lobe][channel][wi][wo], all >= 0 unless of any sign
  std::vector<float> diffuse;  ///< [channel][wi][wo]: integral of gamma (n.wi)(n.wo) / a_v

  [[nodiscard]] double mass(std::size_t lobe, std::size_t channel, std::size_t wi, std::size_t wo) const {
    return masses[((lobe * channels + channel) * directions + wi) * directions + wo];
  }
};

/// The constraints of the projection, which alone does not conserve the sum of the BVNDF.
enum class Energy {
  conserved,  ///< masses are not negative, and rescaled to that sum
  published,  ///< not negative
  any_sign    ///< none
};

/// Solves Eq. 8 for every pair. All values are 0 for directions that see less than 1e-6 of the patch.
[[nodiscard]] Amplitudes solve_amplitudes(const Bvndf& bvndf, const BvndfSums& sums,
                                          std::span<const SphericalGaussian> lobes, Energy energy);

/// The number of Gaussians that the paper takes.
inline constexpr int environment_gaussians = 9;

/// A Gaussian of the light, in world space.
struct LightGaussian {
  SphericalGaussian lobe;
  glm::dvec3 light{0.0};  ///< its integral over all directions, per channel
};

/// At most nine Gaussians fitted to an environment without its small suns, which are lights of their own. Each
/// direction belongs to the Gaussians by their shares of its luminance, so the light of all directions is preserved.
/// Empty: black.
[[nodiscard]] std::vector<LightGaussian> light_gaussians(const Environment& environment);

/// Axis and sharpness of a lobe as a texel, and an image of rows of texels.
[[nodiscard]] glm::vec4 lobe_texel(const SphericalGaussian& lobe);
[[nodiscard]] Image texel_rows(std::size_t width, std::span<const glm::vec4> texels);

/// `iwasaki_environment`: a texel per Gaussian with axis and sharpness, and below it one with its light.
[[nodiscard]] PrefilteredTexture environment_texture(const Environment& environment);

}  // namespace footprint::iwasaki_sg
