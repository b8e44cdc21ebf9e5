// The discretised normals of a surface, which are the cells of a cube map that facets fall in, and the bidirectional
// visible normal distribution of a patch over them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "methods/iwasaki_sg/spherical_gaussian.hpp"
#include "renderer/bake/facets.hpp"
#include "renderer/core/progress.hpp"
#include "renderer/image/image.hpp"
#include "renderer/microgeometry/facet_visibility.hpp"
#include "renderer/microgeometry/patch.hpp"

namespace footprint::iwasaki_sg {

/// Texels per side of a face of the cube map (Iwasaki 2012, section 6).
inline constexpr int cube_side = 128;

/// The cell of a unit vector, 0 to 6 side^2 - 1.
[[nodiscard]] std::uint32_t cube_cell(const glm::dvec3& normal, int side);

/// A normal with the area of its facets.
struct WeightedNormal {
  glm::dvec3 normal{0.0};  ///< a mean of unit vectors, shorter than 1 if they differ
  double weight = 0.0;     ///< above 0
};

/// The samples of one discretised normal and one colour. The paper uses the centre of the cell as normal. This is the
/// mean of the normals in the cell, which is closer and exact for flat facets.
struct NormalBin {
  glm::dvec3 normal;   ///< unit
  std::uint8_t paint;  ///< index into Patch::palette
  std::size_t begin, end;
};

/// Facet samples in the order of their bins.
struct BinnedFacets {
  FacetSamples samples;
  std::vector<NormalBin> bins;  ///< not empty; by colour, then by cell
};

[[nodiscard]] BinnedFacets bin_facets(const Patch& patch, const FacetSamples& samples);

/// The texels of a normal map (4 channels: normal, weight) by cells, renormalised, without texels of weight 0. Weights
/// sum to 1. Empty if no texel is valid.
[[nodiscard]] std::vector<WeightedNormal> bin_normal_map(const Image& normals);

/// Pools normals in the cells of ever coarser cubes until at most `most` remain. Preserves the sum of weight * normal.
[[nodiscard]] std::vector<WeightedNormal> pool_normals(std::vector<WeightedNormal> normals, std::size_t most);

/// gamma(n, wi, wo) (Iwasaki 2012, Eq. 2) over discretised normals and directions: the area of the facets of a normal
/// that is visible from two directions at once, as a count of bits. Only normals with facets are stored.
struct Bvndf {
  std::vector<glm::dvec3> directions;
  std::vector<NormalBin> bins;
  FacetVisibility visibility;  ///< of the samples in the bins' order
  double facet_area = 0.0;
  std::vector<double> visible_area;  ///< a_v of each direction: the projected area of the visible facets

  /// Eq. 2, in the units of area of the patch.
  [[nodiscard]] double gamma(std::size_t bin, std::size_t wi, std::size_t wo) const;
  /// The area of all facets.
  [[nodiscard]] double total_area() const;
};

/// facets: of the patch. Reports the stages visibility and BVNDF as they begin.
[[nodiscard]] Bvndf make_bvndf(const Patch& patch, BinnedFacets facets, std::vector<glm::dvec3> directions,
                               const Progress& progress);

/// The area of each discretised normal that is visible from any direction: Gamma (Eq. 6) without hidden area.
[[nodiscard]] std::vector<WeightedNormal> visible_ndf(const Bvndf& bvndf);

/// The weight of a facet in the specular term, apart from its visibility. base: (n.wo), because the scene's base BRDF
/// is given as f cos. published: (n.wi)(n.wo), Eq. 5.
enum class Cosines { base, published };

/// Sums over the discretised normals for every pair of directions, wi-major, before the division by a_v. `channels` is
/// 1, or 3 in colour.
struct BvndfSums {
  std::size_t directions = 0, lobes = 0, channels = 1;
  std::vector<float> products;  ///< [channel][lobe][wi][wo]: sum of gamma * cosines * (lobe over the normal)
  std::vector<float> totals;    ///< [channel][wi][wo]: sum of gamma * cosines
  std::vector<float> diffuse;   ///< [channel][wi][wo]: sum of gamma (n.wi)(n.wo)
};

/// The right sides of Eq. 8. `paints`: the factors of each paint; a single channel uses red. A discretised normal is a
/// lobe of sharpness `sharpest` (lobe_fit.hpp). Equal results at any number of threads.
[[nodiscard]] BvndfSums sum_bvndf(const Bvndf& bvndf, std::span<const SphericalGaussian> lobes, Cosines cosines,
                                  std::size_t channels, std::span<const PaintFactors> paints, const Progress& progress);

}  // namespace footprint::iwasaki_sg
