// The reference NDF of a footprint: the mean over all facets of their base lobes, 1/sr; quadrature over the hemisphere,
// and statistics of NDFs.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "renderer/core/progress.hpp"
#include "renderer/lobes/lobe.hpp"
#include "renderer/ndf/footprint_texels.hpp"

namespace footprint {

/// The mean over facets of their lobes, in double precision. The result is independent of the number of threads.
class ReferenceNdf {
 public:
  /// `facets`: unit normals, or means of neighbouring normals (`merged_facets`). Groups them into cells, so that a
  /// direction only visits those whose lobes reach it.
  ReferenceNdf(NormalDistribution distribution, const std::vector<WeightedFacet>& facets);

  /// The density at each direction; 0 for directions of length 0. Skips facets whose lobe is below `lobe_cutoff` of its
  /// peak; the others have an error below 2e-9 of the peak. Exceptions of `progress` pass through.
  [[nodiscard]] std::vector<double> densities(std::span<const glm::vec3> directions, const Progress& progress) const;

  /// The integral over the upper hemisphere, summed from the integrals of the lobes (`lobe_energy`). It is 1 minus the
  /// part below the horizon; microfacet densities (beckmann, ggx) exceed that. Error below 1e-3.
  [[nodiscard]] double expected_energy() const;

  /// The narrowest lobe under the footprint; of anisotropic lobes the round one of its width across.
  [[nodiscard]] Lobe narrowest() const;

 private:
  struct Facet {
    glm::dvec3 normal;
    double slack;      // (1 - |normal|^2) / 2, so that u = |h - normal|^2 / 2 + slack also for a mean of normals
    double parameter;  // of the lobe
    double amplitude;  // share times the lobe's peak; among anisotropic lobes the share
    glm::dvec2 stretch;
  };
  // Neighbours: facets [first, last) lie within `radius` (chord) of `centre`; their lobes reach `reach` (chord).
  struct Cell {
    glm::dvec3 centre;
    double radius, reach;
    std::size_t first, last;
  };
  template <class Shape>
  [[nodiscard]] double density(const glm::dvec3& direction, const Shape& shape) const;
  // The density of a facet among anisotropic ones.
  [[nodiscard]] double stretched(const Facet& facet, const glm::dvec3& direction) const;
  [[nodiscard]] Alphas alphas(const Facet& facet) const;
  [[nodiscard]] double energy(const Facet& facet) const;

  NormalDistribution distribution_;
  bool anisotropic_;  // whether any facet is
  std::vector<Facet> facets_;
  std::vector<Cell> cells_;
  std::optional<LobeProfile> profile_;  // if all facets have the same lobe
};

/// Directions and the solid angle of each; the sum is 2 pi.
struct HemisphereGrid {
  int resolution = 0;                 ///< rings
  std::vector<glm::vec3> directions;  ///< unit, z > 0
  std::vector<double> solid_angles;
};

inline constexpr int smallest_resolution = 16, largest_resolution = 2048;

/// Gauss-Legendre quadrature in z with `resolution` rings. Directions on a ring are evenly spaced, at most as far apart
/// as the rings (2.2 / resolution radians). The horizon is represented exactly, unlike on an even grid, and smooth
/// densities converge as Gauss quadrature does.
[[nodiscard]] HemisphereGrid hemisphere_grid(int resolution);

/// The resolution whose directions are half a lobe width apart; at least 64 and at most `largest_resolution`. Sums over
/// the grid integrate the lobe and its square to 1e-4 and miss the peak by at most 6%.
[[nodiscard]] int resolution_for(const Lobe& narrowest);

/// The approximate number of directions of a grid.
[[nodiscard]] double direction_count(int resolution);

/// The directions of the pixel centres in a size x size image of the disc |(x, y)| < 1, with x to the right, y up and
/// row 0 at the top. (0, 0, 0) outside the disc.
[[nodiscard]] std::vector<glm::vec3> disc_directions(int size);

/// Statistics of a density D against a reference R, over a grid. Not finite if a density is not finite.
struct NdfFigures {
  double l2 = 0.0;      ///< sqrt(int (D - R)^2 / int R^2), over solid angle
  double energy = 0.0;  ///< int D / int R
  double peak = 0.0;    ///< the largest D
};

/// Compares densities with a reference, both per solid angle at the directions of the grid.
[[nodiscard]] NdfFigures compare_ndfs(const HemisphereGrid& grid, std::span<const float> densities,
                                      std::span<const double> reference);

/// The largest density; NaN if a density is not finite.
[[nodiscard]] double largest_density(std::span<const float> densities);

/// The integral over the hemisphere and the largest density.
struct NdfTotals {
  double energy = 0.0, peak = 0.0;
};
[[nodiscard]] NdfTotals ndf_totals(const HemisphereGrid& grid, std::span<const double> densities);

}  // namespace footprint
