// The amplitudes mu_j(wi, wo) of the NDF's lobes: a least-squares projection of the BVNDF for each pair of directions.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "methods/iwasaki_sg/bvndf.hpp"
#include "methods/iwasaki_sg/ndf_fit.hpp"
#include "methods/iwasaki_sg/spherical_gaussian.hpp"

namespace footprint::iwasaki_sg {

/// A small matrix or vector that lives on the stack.
using LobeMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_lobes, most_lobes>;
using LobeVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_lobes, 1>;

/// A of Eq. 8 scaled to a unit diagonal: the correlations of the lobes.
[[nodiscard]] LobeMatrix correlations(std::span<const SphericalGaussian> lobes);

/// The x >= 0 that minimises x.(A x) / 2 - b.x for a positive definite A: active sets on the normal equations (Lawson
/// and Hanson 1974, chapter 23; Bro and De Jong 1997).
[[nodiscard]] LobeVector solve_non_negative(const LobeMatrix& a, const LobeVector& b);

/// What a material's table is made of. `masses` are the amplitudes times their lobes' integrals (`integral`), which
/// stay within 0 to about 1 where amplitudes reach 1e5.
struct Amplitudes {
  std::vector<SphericalGaussian> lobes;
  std::size_t directions = 0, channels = 1;
  std::vector<float> masses;   ///< [lobe][channel][wi][wo], all >= 0
  std::vector<float> diffuse;  ///< [channel][wi][wo]: integral of gamma (n.wi)(n.wo) / a_v
};

/// Whether the masses are rescaled so that they sum to what the BVNDF holds. The projection alone does not conserve it.
enum class Energy { published, conserved };

/// Solves Eq. 8 for every pair. Where a direction sees less than 1e-6 of the patch all is 0.
[[nodiscard]] Amplitudes solve_amplitudes(const Bvndf& bvndf, const BvndfSums& sums,
                                          std::span<const SphericalGaussian> lobes, Energy energy);

}  // namespace footprint::iwasaki_sg
