// The discretised normals of a surface: the cells of a cube map that some facet's normal falls in.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "renderer/image/image.hpp"
#include "renderer/microgeometry/facet_visibility.hpp"
#include "renderer/microgeometry/patch.hpp"

namespace footprint::iwasaki_sg {

/// Texels a side of a face of the cube map (Iwasaki 2012, section 6).
inline constexpr int cube_side = 128;

/// The cell of a unit vector, 0 to 6 side^2 - 1.
[[nodiscard]] std::uint32_t cube_cell(const glm::dvec3& normal, int side);

/// A normal with the area of the facets that have it.
struct WeightedNormal {
  glm::dvec3 normal;  ///< a mean of unit vectors: shorter than 1 where it stands for several
  double weight;      ///< above 0
};

/// The samples of one discretised normal and one colour. The paper takes a cell's centre for its normal; the mean of
/// those that fall in it is nearer, and exact for flat facets.
struct NormalBin {
  glm::dvec3 normal;   ///< unit
  std::uint8_t paint;  ///< index into Patch::palette
  std::size_t begin, end;
};

/// Facet samples in the order of their bins.
struct BinnedFacets {
  FacetSamples samples;
  std::vector<NormalBin> bins;  ///< none is empty; by colour, then by cell
};

[[nodiscard]] BinnedFacets bin_facets(const Patch& patch, const FacetSamples& samples);

/// The texels of a normal map (4 channels: normal, weight) by cells: those of weight 0 left out, normals renormalised.
/// Weights sum to 1; empty where no texel is valid.
[[nodiscard]] std::vector<WeightedNormal> bin_normal_map(const Image& normals);

/// Pools normals by the cells of ever coarser cubes until at most `most` are left. The sum of weight * normal stays.
[[nodiscard]] std::vector<WeightedNormal> pool_normals(std::vector<WeightedNormal> normals, std::size_t most);

}  // namespace footprint::iwasaki_sg
