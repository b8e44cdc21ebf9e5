// The exact NDF of a footprint: the mean of the base lobe about every facet, a density over solid angle.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "renderer/core/progress.hpp"
#include "renderer/lobes/lobe.hpp"
#include "renderer/ndf/footprint_texels.hpp"

namespace footprint {

/// The mean over facets of their lobes. Double precision; the result does not depend on the number of threads.
class TrueNdf {
 public:
  /// Facets whose normals are unit, or means of normals that lie together (`merged_facets`). They are kept in cells of
  /// neighbours, so that a direction asks only those whose lobes reach it.
  TrueNdf(NormalDistribution distribution, const std::vector<WeightedFacet>& facets);

  /// The density at each direction. A facet farther from a direction than its lobe's support does not enter: what is
  /// left out is below `lobe_cutoff` of the lobe's peak, and what stays is within 2e-9 of it. Directions of length 0
  /// give 0. Throws as `progress`.
  [[nodiscard]] std::vector<double> densities(std::span<const glm::vec3> directions, const Progress& progress) const;

  /// The integral over the upper hemisphere that the lobes' own integrals give (`lobe_energy`): one, but for what lies
  /// below the horizon, and for the microfacet densities (beckmann, ggx) above that. To 1e-3.
  [[nodiscard]] double expected_energy() const;

  /// The narrowest lobe under the footprint.
  [[nodiscard]] Lobe narrowest() const;

 private:
  struct Facet {
    glm::dvec3 normal;
    double slack;      // (1 - |normal|^2) / 2: u = |h - normal|^2 / 2 + slack, also for a mean of normals
    double parameter;  // of the lobe
    double amplitude;  // share times the lobe's peak
  };
  // Neighbours: facets [first, last) lie within `radius` (chord) of `centre`; their lobes reach `reach` (chord).
  struct Cell {
    glm::dvec3 centre;
    double radius, reach;
    std::size_t first, last;
  };
  template <class Shape>
  [[nodiscard]] double density(const glm::dvec3& direction, const Shape& shape) const;

  NormalDistribution distribution_;
  std::vector<Facet> facets_;
  std::vector<Cell> cells_;
  std::optional<LobeProfile> profile_;  // of the lobe, where all facets have the same
};

}  // namespace footprint
