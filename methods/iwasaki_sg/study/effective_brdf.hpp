// Three forms of the effective BRDF in double precision: the sum over a patch's facets (Iwasaki 2012, Eq. 1), a dense
// table of such sums (as Wu et al. 2011 store it), and the lobes of the material's table (the twin of the specular term
// in iwasaki_sg.glsl). Also how far the latter two are from the sum.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <variant>
#include <vector>

#include "methods/iwasaki_sg/bvndf.hpp"
#include "methods/iwasaki_sg/material_table.hpp"
#include "methods/iwasaki_sg/spherical_gaussian.hpp"
#include "renderer/core/options.hpp"
#include "renderer/core/progress.hpp"
#include "renderer/lobes/lobe.hpp"
#include "renderer/microgeometry/tabulated_brdf.hpp"
#include "renderer/scene/material.hpp"

namespace footprint::iwasaki_sg {

/// f cos of an effective BRDF for unit vectors to the light and to the viewer, a value a channel.
using BrdfFunction = std::function<glm::dvec3(const glm::dvec3& wi, const glm::dvec3& wo)>;

/// Eq. 1 over the facets of a material's patch, times the cosine to the light: of the base BRDF the normal distribution
/// alone (without Fresnel and geometry terms), of a tabulated one all.
class FacetSum {
 public:
  /// The material has a patch, of which `facets` are samples. `settings` say the cosines and the channels.
  FacetSum(const Material& material, const TableSettings& settings, BinnedFacets facets,
           std::vector<glm::dvec3> directions, const Progress& progress);

  /// For directions by their indices in the list.
  [[nodiscard]] glm::dvec3 operator()(std::size_t wi, std::size_t wo) const;

  [[nodiscard]] const std::vector<glm::dvec3>& directions() const { return bvndf_.directions; }

 private:
  [[nodiscard]] double base_density(const glm::dvec3& normal, const glm::dvec3& h) const;

  Bvndf bvndf_;
  Lobe lobe_;
  double support_;  // of the base lobe
  const TabulatedBrdf* table_;
  Cosines cosines_;
  std::size_t channels_;
  std::vector<PaintFactors> paints_;
};

/// A table of the sum for `side` x `side` directions to the light and as many to the viewer, over the same discretised
/// normals as the lobes', interpolated between directions. Like the table of the lobes' amplitudes it holds f cos over
/// the cosine where the facets' own cosine is in it.
class DenseTable {
 public:
  /// `side` is 2 or more; time grows as its fourth power.
  DenseTable(const Material& material, const TableSettings& settings, int side, const Progress& progress);

  [[nodiscard]] glm::dvec3 operator()(const glm::dvec3& wi, const glm::dvec3& wo) const;

  /// Of its 32-bit floats.
  [[nodiscard]] static std::size_t byte_count(int side, std::size_t channels);

 private:
  int side_;
  bool with_cosine_;
  std::vector<glm::vec3> values_;  // [wi][wo]
};

/// Root mean square difference of an effective BRDF from the sum over facets, over the root mean square of the sum, for
/// 192 random directions to the light with each of 192 to the viewer, uniform over what is 3 degrees or more above
/// the horizon. The sum is over facets drawn apart from the method's, each with its triangle's own normal.
[[nodiscard]] double relative_error(const Material& material, const TableSettings& settings, const BrdfFunction& brdf);

/// What facets reflect with: the base lobe, that lobe as spherical Gaussians of unit energy, or those of a tabulated
/// BRDF with its diffuse term.
using FacetReflection = std::variant<Lobe, std::vector<BrdfLobe>, TabulatedLobes>;

/// That of a material by the option `lobe`; a tabulated BRDF where the facets have one.
[[nodiscard]] FacetReflection facet_reflection(const Material& material, const Options& options);

/// f cos of the effective BRDF but for the Fresnel and geometry terms (all of it, where the BRDF is tabulated): Eq. 15,
/// with amplitudes interpolated between the table's directions.
class EffectiveBrdf {
 public:
  /// `approximate`: Eq. 14 in place of Eq. 11 for a base lobe in spherical Gaussians. Refers to the table.
  EffectiveBrdf(const MaterialTable& table, const TableSettings& settings, FacetReflection reflection,
                bool approximate);

  /// Of unit vectors above the horizon, in each channel; a table of one channel has it in all.
  [[nodiscard]] glm::dvec3 operator()(const glm::dvec3& wi, const glm::dvec3& wo) const;

 private:
  [[nodiscard]] glm::dvec3 convolved(const SphericalGaussian& lobe, const glm::dvec3& h, const glm::dvec3& wi) const;
  [[nodiscard]] std::vector<glm::dvec3> masses(const glm::dvec3& wi, const glm::dvec3& wo) const;

  const MaterialTable& table_;
  int side_;
  std::vector<glm::dvec3> directions_;
  bool with_cosine_;  // whether masses have the facets' cosine to the light
  FacetReflection reflection_;
  bool approximate_;
};

}  // namespace footprint::iwasaki_sg
