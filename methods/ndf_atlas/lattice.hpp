// The facets of a material and the lattice that their densities are tabulated over: a rectangle of Lambert's equal-area
// map, as wide as the normals with their lobes, and as fine as the narrowest lobe.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "renderer/lobes/lobe.hpp"
#include "renderer/scene/material.hpp"

namespace footprint::ndf_atlas {

struct Facets {
  int width = 0, height = 0;
  NormalDistribution distribution = NormalDistribution::blinn_phong;
  std::vector<glm::vec3> normals;  ///< unit, row by row; zero where the map has none
  std::vector<float> parameters;   ///< of each facet's lobe, or one for all

  [[nodiscard]] bool is_valid(std::size_t i) const { return normals[i] != glm::vec3(0.0F); }
  [[nodiscard]] Lobe lobe(std::size_t i) const {
    return {distribution, static_cast<double>(parameters[parameters.size() == 1 ? 0 : i])};
  }
};

/// Those of a material; `rough`: each with the lobe of the texel of the roughness map above it. None where that map
/// does not lie on the normal map's texels, or is finer.
[[nodiscard]] std::optional<Facets> facets_of(const Material& material, bool rough);

/// n_xy sqrt(2 / (1 + n_z)) of a unit vector: Lambert's azimuthal equal-area map from the surface's normal. The horizon
/// is at the radius sqrt(2), the direction below at 2.
[[nodiscard]] glm::dvec2 plane_of(const glm::dvec3& direction);

/// The unit vector over a point of the plane; points beyond the radius 2 count as on it.
[[nodiscard]] glm::dvec3 direction_over(const glm::dvec2& point);

/// The angle from a lobe's axis beyond which lies less than `outside` of its energy over the sphere; at most pi.
[[nodiscard]] double lobe_reach(const Lobe& lobe, double outside);

/// What a table leaves out of a lobe.
inline constexpr double energy_outside = 5e-4;

/// Nodes at origin + (i, j) step.
struct Lattice {
  glm::ivec2 nodes{2};
  glm::dvec2 origin{0.0};
  glm::dvec2 step{1.0};

  [[nodiscard]] std::size_t node_count() const {
    return static_cast<std::size_t>(nodes.x) * static_cast<std::size_t>(nodes.y);
  }
  [[nodiscard]] glm::dvec2 point(int i, int j) const { return origin + step * glm::dvec2(i, j); }
};

/// The lattice around all valid facets whose nodes lie no farther apart than `step` of the deviation of the Gaussian
/// that is as curved as the narrowest lobe's peak (GGX: alpha / 2, else `lobe_width`), and at most two steps below the
/// horizon. One that needs more than a million nodes along an edge has so many.
[[nodiscard]] Lattice lattice_over(const Facets& facets, double step);

}  // namespace footprint::ndf_atlas
