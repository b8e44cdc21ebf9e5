// The bidirectional visible normal distribution of a patch, and its sums over the discretised normals.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "methods/iwasaki_sg/normal_bins.hpp"
#include "methods/iwasaki_sg/spherical_gaussian.hpp"
#include "renderer/bake/facets.hpp"
#include "renderer/core/progress.hpp"
#include "renderer/microgeometry/facet_visibility.hpp"

namespace footprint::iwasaki_sg {

/// gamma(n, wi, wo) (Iwasaki 2012, Eq. 2) over discretised normals and directions: what the facets of a normal see of
/// two directions at once. Only normals that facets have are kept; a value is a count of bits.
struct Bvndf {
  std::vector<glm::dvec3> directions;
  std::vector<NormalBin> bins;
  FacetVisibility visibility;  ///< of the samples in the bins' order
  double facet_area = 0.0;
  std::vector<double> visible_area;  ///< a_v of each direction: the visible facets' projected area

  /// Eq. 2, in the patch's units of area.
  [[nodiscard]] double gamma(std::size_t bin, std::size_t wi, std::size_t wo) const;
  /// The area of all facets.
  [[nodiscard]] double total_area() const;
};

[[nodiscard]] Bvndf make_bvndf(BinnedFacets facets, FacetVisibility visibility, std::vector<glm::dvec3> directions);

/// The area of each discretised normal that any direction sees: Gamma (Eq. 6) without what is buried.
[[nodiscard]] std::vector<WeightedNormal> visible_ndf(const Bvndf& bvndf);

/// With what the specular term weighs a facet beside its visibility. base: (n.wo), since the scene's base BRDF
/// is given as f cos; published: (n.wi)(n.wo), Eq. 5.
enum class Cosines { base, published };

/// Sums over the discretised normals for every pair of directions, wi-major; `channels` is 1 or, in
/// colour, 3. Not yet divided by a_v.
struct BvndfSums {
  std::size_t directions = 0, lobes = 0, channels = 1;
  std::vector<float> products;  ///< [channel][lobe][wi][wo]: sum of gamma * cosines * (lobe over the normal)
  std::vector<float> totals;    ///< [channel][wi][wo]: sum of gamma * cosines
  std::vector<float> diffuse;   ///< [channel][wi][wo]: sum of gamma (n.wi)(n.wo)
};

/// The right sides of Eq. 8. `paints` has the factors of each paint, of which one channel takes red. A discretised
/// normal is a lobe of sharpness `sharpest` (ndf_fit.hpp). The result does not depend on the number of threads.
[[nodiscard]] BvndfSums sum_bvndf(const Bvndf& bvndf, std::span<const SphericalGaussian> lobes, Cosines cosines,
                                  std::size_t channels, std::span<const PaintFactors> paints, const Progress& progress);

}  // namespace footprint::iwasaki_sg
