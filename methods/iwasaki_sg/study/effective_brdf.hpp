// Three forms of the effective BRDF in double precision: the sum over a patch's facets (Iwasaki 2012, Eq. 1), a dense
// table of such sums (as Wu et al. 2011 store it), and the lobes of the material's table (the twin of the specular term
// in iwasaki_sg.glsl). Also how far the latter two are from the sum, and the accuracy of the fits of lobes.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <variant>
#include <vector>

#include "methods/iwasaki_sg/bvndf.hpp"
#include "methods/iwasaki_sg/material_table.hpp"
#include "methods/iwasaki_sg/spherical_gaussian.hpp"
#include "renderer/core/options.hpp"
#include "renderer/core/progress.hpp"
#include "renderer/lobes/lobe.hpp"
#include "renderer/microgeometry/microgeometry.hpp"
#include "renderer/scene/material.hpp"

namespace footprint::iwasaki_sg {

/// The sizes of the matrix.
struct LowRank {
  int side = 24;     ///< of the grids of directions to the light and to the viewer
  int normals = 40;  ///< side of the grid of normals
  int values = 70;   ///< singular values that are stored
};

/// The density of a lobe at the normals of the grid, projected to the first right singular vectors of the matrix. Wu et
/// al. approximate these by random projections (Vempala 2004), so their error is at least that of this form.
class LowRankLobe {
 public:
  /// The matrix has a row per pair of directions, of which 16384 at equal distances are decomposed.
  LowRankLobe(const Lobe& lobe, const LowRank& sizes);

  /// The coefficients of a row, whose half vector is `h`.
  [[nodiscard]] Eigen::VectorXd row(const glm::dvec3& h) const;

  /// The density at a normal, interpolated between the grid's; below 0 where the vectors that are left out would lift
  /// it.
  [[nodiscard]] double density(const Eigen::VectorXd& row, const glm::dvec3& normal) const;

  /// The bytes of the 32-bit floats of both factors. A pair and its reverse, which are equal by reciprocity, are one
  /// row.
  [[nodiscard]] static std::size_t byte_count(const LowRank& sizes);

 private:
  Lobe lobe_;
  int side_;                         // of the grid of normals
  std::vector<glm::dvec3> normals_;  // of that grid
  Eigen::MatrixXd vectors_;          // right singular vectors, a column each
};

/// f cos of an effective BRDF for unit vectors to the light and to the viewer, one value per channel.
using BrdfFunction = std::function<glm::dvec3(const glm::dvec3& wi, const glm::dvec3& wo)>;

/// Eq. 1 over the facets of a material's patch, times the cosine to the light. A base BRDF contributes only its normal
/// distribution (without Fresnel and geometry terms), a tabulated BRDF all of it.
class FacetSum {
 public:
  /// The material has a patch, and `facets` are samples of it. `settings` give the cosines and the channels.
  FacetSum(const Material& material, const TableSettings& settings, BinnedFacets facets,
           std::vector<glm::dvec3> directions, const Progress& progress);

  /// Replaces the base lobe by a compressed one.
  void compress(const LowRank& sizes) { compressed_.emplace(lobe_, sizes); }

  /// The sum for two directions by their indices in the list.
  [[nodiscard]] glm::dvec3 operator()(std::size_t wi, std::size_t wo) const;

  [[nodiscard]] const std::vector<glm::dvec3>& directions() const { return bvndf_.directions; }

 private:
  Bvndf bvndf_;
  Lobe lobe_;
  double support_;  // of the base lobe
  const TabulatedBrdf* table_;
  TableSettings settings_;
  std::optional<LowRankLobe> compressed_;
};

/// A table of the sum for `side` x `side` directions to the light and as many to the viewer, interpolated between
/// directions. It has the same discretised normals as the lobes. Like the table of amplitudes it stores f cos divided
/// by the cosine if the facets' own cosine is included.
/// side: 2 or more; time grows as its fourth power.
/// compressed: the sizes of a base lobe as Wu et al. compress it; none: the lobe itself.
[[nodiscard]] BrdfFunction dense_table(const Material& material, const TableSettings& settings, int side,
                                       const Progress& progress, const std::optional<LowRank>& compressed = {});

/// The bytes of its 32-bit floats.
[[nodiscard]] std::size_t dense_table_bytes(int side, std::size_t channels);

/// Root mean square difference between an effective BRDF and the sum over facets, divided by the root mean square of
/// the sum. Over all pairs of 192 random directions to the light and 192 to the viewer, uniform above 3 degrees over
/// the horizon. The sum is over facets that are drawn independently of the method, each with the normal of its
/// triangle.
[[nodiscard]] double relative_error(const Material& material, const TableSettings& settings, const BrdfFunction& brdf);

/// The reflection of facets: the base lobe, that lobe as spherical Gaussians of unit energy, or the lobes of a
/// tabulated BRDF with its diffuse term.
using FacetReflection = std::variant<Lobe, std::vector<BrdfLobe>, TabulatedLobes>;

/// The reflection of a material by the option `lobe`, or its tabulated BRDF if it has one.
[[nodiscard]] FacetReflection facet_reflection(const Material& material, const Options& options);

/// f cos of the effective BRDF without the Fresnel and geometry terms (a tabulated BRDF includes them): Eq. 15, with
/// amplitudes interpolated between the directions of the table, to which it stores a reference. For unit vectors above
/// the horizon; a table of one channel gives the same value in all.
/// approximate: Eq. 14 instead of Eq. 11 for a base lobe of spherical Gaussians.
[[nodiscard]] BrdfFunction effective_brdf(const MaterialTable& table, const TableSettings& settings,
                                          FacetReflection reflection, bool approximate);

/// The largest absolute difference between Eq. 11 and Eq. 14 over all angles between the axes (Iwasaki 2012, Figure 5),
/// with amplitudes of 1.
[[nodiscard]] double convolution_error(double sharpness1, double sharpness2);

/// The largest absolute difference between Eq. 11 and the SG that Jakob 2012 convolves to, over the same angles. The
/// length of its mean vector is the product of the two (vMF), and its value is that of Eq. 11 where the axes meet.
[[nodiscard]] double jakob_convolution_error(double sharpness1, double sharpness2);

/// Root mean square differences between gamma~ = gamma (cosines) / a_v and its lobes, over the paper's 6x128x128
/// normals and all pairs of directions. Lobes are integrated over cells. The single normal of a facet is as wide as the
/// sharpest lobe, so that both sides have one kernel. The paper prints percentages of this kind without their domain.
/// Here both sides are shares of the visible area, 1 being all, so `rms` is small because most cells of most pairs are
/// empty.
struct FitErrors {
  double rms;
  double
      relative;  ///< over the root mean square of gamma~: 0 for a perfect fit, about 1 for lobes far from its normals
  double occupied;  ///< over the cells that contain facets alone, as a mean over those cells and all pairs
};

/// Treats the patch as of one colour.
[[nodiscard]] FitErrors fit_errors(const Patch& patch, const TableSettings& settings);

/// The relative error of both sides after a convolution with a lobe of `sharpness` (above 0), over the whole sphere:
/// what a base BRDF of that sharpness shows of the difference. In closed form, by the products of lobes.
[[nodiscard]] double convolved_fit_rms(const Patch& patch, const TableSettings& settings, double sharpness);

}  // namespace footprint::iwasaki_sg
