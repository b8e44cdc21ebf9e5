// The reference NDF of a footprint: the mean over all facets of their base lobes, 1/sr.
#pragma once

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
  /// anisotropy: stretches every lobe; the facets' parameters are then those of the round means.
  ReferenceNdf(NormalDistribution distribution, const std::vector<WeightedFacet>& facets,
               const std::optional<Anisotropy>& anisotropy = {});

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
    double amplitude;  // share times the lobe's peak; of an anisotropic lobe the share
  };
  // Neighbours: facets [first, last) lie within `radius` (chord) of `centre`; their lobes reach `reach` (chord).
  struct Cell {
    glm::dvec3 centre;
    double radius, reach;
    std::size_t first, last;
  };
  template <class Shape>
  [[nodiscard]] double density(const glm::dvec3& direction, const Shape& shape) const;
  // The density of an anisotropic facet.
  [[nodiscard]] double stretched(const Facet& facet, const glm::dvec3& direction) const;
  [[nodiscard]] Alphas alphas(const Facet& facet) const;
  [[nodiscard]] double energy(const Facet& facet) const;

  NormalDistribution distribution_;
  std::optional<Anisotropy> anisotropy_;
  std::vector<Facet> facets_;
  std::vector<Cell> cells_;
  std::optional<LobeProfile> profile_;  // if all facets have the same lobe
};

}  // namespace footprint
