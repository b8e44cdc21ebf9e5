// The facets of a material and the lattice that their densities are tabulated over: a rectangle of Lambert's equal-area
// map, as wide as the normals with their lobes, and as fine as the narrowest lobe. The tables of all levels are packed
// into one texture. The block of each texel contains the tables of its four bilinear neighbours in four channels, so
// that one fetch blends nodes and texels at once.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "renderer/bake/prefiltered.hpp"
#include "renderer/core/progress.hpp"
#include "renderer/lobes/lobe.hpp"
#include "renderer/scene/material.hpp"

namespace footprint::ndf_atlas {

struct Facets {
  int width = 0, height = 0;
  NormalDistribution distribution = NormalDistribution::blinn_phong;
  std::vector<glm::vec3> normals;  ///< unit, row by row; zero if invalid
  std::vector<float> parameters;   ///< lobe parameter of each facet, or one for all; of the round mean if anisotropic
  std::vector<glm::vec2> stretches{};  ///< of each facet, or one for all (stretch_of); empty: all are round

  [[nodiscard]] bool is_valid(std::size_t i) const { return normals[i] != glm::vec3(0.0F); }
  [[nodiscard]] Lobe lobe(std::size_t i) const {
    return {distribution, static_cast<double>(parameters[parameters.size() == 1 ? 0 : i])};
  }
  [[nodiscard]] glm::dvec2 stretch(std::size_t i) const {
    return stretches.empty() ? glm::vec2(0.0F) : stretches[stretches.size() == 1 ? 0 : i];
  }
  /// The widths of an anisotropic facet.
  [[nodiscard]] Alphas alphas(std::size_t i) const { return alphas_of_stretch(lobe(i).parameter, stretch(i)); }
};

/// The facets of a material. `rough`: with the roughness texels above; none unless these lie on the normal map's.
[[nodiscard]] std::optional<Facets> collect_facets(const Material& material, bool rough);

/// n_xy sqrt(2 / (1 + n_z)): Lambert's azimuthal equal-area map; the horizon has radius sqrt(2), the pole below 2.
[[nodiscard]] glm::dvec2 plane_of(const glm::dvec3& direction);

/// The unit vector of a point of the plane; points beyond the radius 2 are moved onto it.
[[nodiscard]] glm::dvec3 direction_over(const glm::dvec2& point);

/// The angle from a lobe's axis beyond which less than `outside` of its energy over the sphere remains; at most pi.
[[nodiscard]] double lobe_reach(const Lobe& lobe, double outside);

/// The energy of a lobe that a table omits.
inline constexpr double energy_outside = 5e-4;

/// Nodes at origin + (i, j) step.
struct Lattice {
  glm::ivec2 nodes{2};
  glm::dvec2 origin{0.0};
  glm::dvec2 step{1.0};
  double reach = 0.0;  ///< of the widest lobe (lobe_reach)

  [[nodiscard]] std::size_t node_count() const {
    return static_cast<std::size_t>(nodes.x) * static_cast<std::size_t>(nodes.y);
  }
  [[nodiscard]] glm::dvec2 point(int i, int j) const { return origin + step * glm::dvec2(i, j); }
};

/// The lattice around all valid facets. Its nodes are at most `step` apart, in deviations of the Gaussian that is as
/// curved as the peak of the narrowest lobe (GGX: alpha / 2, otherwise `lobe_width`). It extends at most two steps
/// below the horizon, and has at most a million nodes per edge.
[[nodiscard]] Lattice lattice_over(const Facets& facets, double step);

/// The tables of one level: node (i, j) of texel (x, y) is at ((y width + x) nodes.y + j) nodes.x + i.
struct LevelTables {
  int width = 0, height = 0;
  std::size_t nodes = 0;        ///< of each table
  std::vector<float> density;   ///< per solid angle: the mean over the valid facets under the texel
  std::vector<float> coverage;  ///< per texel: the share that has valid facets

  [[nodiscard]] std::span<const float> table(std::size_t texel) const {
    return std::span(density).subspan(texel * nodes, nodes);
  }
  [[nodiscard]] std::span<float> table(std::size_t texel) { return std::span(density).subspan(texel * nodes, nodes); }
};

/// The tables of `level`, 0 being the finest. Equal arguments give equal values at any number of threads.
[[nodiscard]] LevelTables build_tables(const Facets& facets, const Lattice& lattice, int level,
                                       const Progress& progress);

/// The next coarser level: means over areas, as in a mip chain.
[[nodiscard]] LevelTables coarser(const LevelTables& fine);

/// Subtracts a twelfth of the second differences along both axes from the node values, clamps nodes to 0, and preserves
/// the sum. A bilinear lookup is off by an eighth of the second differences in the middle of a cell and by a twelfth on
/// average, so this removes half of the error. The density is 0 beyond the lattice.
void correct_for_bilinear(std::span<float> table, const Lattice& lattice);

/// Sets the outermost nodes above the horizon to 0, because a lookup beyond the lattice returns its border.
void close_border(std::span<float> table, const Lattice& lattice);

/// `table` divided by `scale`, in bytes. The rounding error of each node is passed on to the next one, row by row in
/// alternating direction, so that the sum stays within half a step: the nearest byte loses everything below that.
[[nodiscard]] std::vector<std::uint8_t> bytes_of(std::span<const float> table, int width, float scale);

/// The blocks of all levels from `first_level` on, in sequence, in rows of `columns` blocks (a power of two).
struct AtlasLayout {
  int first_level = 0;
  glm::ivec2 nodes{2};
  int columns = 1;
  int rows = 1;

  [[nodiscard]] std::size_t byte_count(Storage storage) const;
};

/// The number of nodes of all blocks, with four tables each, of a normal map of width x height texels from a level on.
[[nodiscard]] double node_count(int width, int height, const Lattice& lattice, int first_level);

/// The layout of such a map, of up to 480 megabytes at 16384 texels per edge. Errors: std::logic_error beyond.
[[nodiscard]] AtlasLayout layout_for(int width, int height, const Lattice& lattice, int first_level);

/// The textures `ndf_atlas_densities`, nodes divided by the scale of their table, and `ndf_atlas_blocks`, two texels
/// per block with the scales and the coverages of its four tables. `level`: the uncorrected tables of the first level.
[[nodiscard]] std::array<PrefilteredTexture, 2> atlas_textures(LevelTables level, const Lattice& lattice,
                                                               const AtlasLayout& layout, Storage storage,
                                                               const std::array<Wrap, 2>& wrap);

}  // namespace footprint::ndf_atlas
