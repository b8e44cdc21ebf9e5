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
  std::vector<glm::vec3> normals;  ///< unit, row by row; zero if invalid
  std::vector<float> parameters;   ///< lobe parameter of each facet, or one for all; of the round mean if anisotropic
  std::optional<Anisotropy> anisotropy{};

  [[nodiscard]] bool is_valid(std::size_t i) const { return normals[i] != glm::vec3(0.0F); }
  [[nodiscard]] Lobe lobe(std::size_t i) const {
    return {distribution, static_cast<double>(parameters[parameters.size() == 1 ? 0 : i])};
  }
  /// The widths of an anisotropic facet.
  [[nodiscard]] Alphas alphas(std::size_t i) const { return alphas_of_round(anisotropy->strength, lobe(i).parameter); }
};

/// The facets of a material. `rough`: each has the lobe of the roughness texel above it. None if the roughness map does
/// not lie on the normal map's texels or is finer.
[[nodiscard]] std::optional<Facets> facets_of(const Material& material, bool rough);

/// n_xy sqrt(2 / (1 + n_z)) of a unit vector: Lambert's azimuthal equal-area map from the surface's normal. The horizon
/// has the radius sqrt(2), the direction below the radius 2.
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

  [[nodiscard]] std::size_t node_count() const {
    return static_cast<std::size_t>(nodes.x) * static_cast<std::size_t>(nodes.y);
  }
  [[nodiscard]] glm::dvec2 point(int i, int j) const { return origin + step * glm::dvec2(i, j); }
};

/// The lattice around all valid facets. Its nodes are at most `step` apart, in deviations of the Gaussian that is as
/// curved as the peak of the narrowest lobe (GGX: alpha / 2, otherwise `lobe_width`). It extends at most two steps
/// below the horizon, and has at most a million nodes per edge.
[[nodiscard]] Lattice lattice_over(const Facets& facets, double step);

}  // namespace footprint::ndf_atlas
