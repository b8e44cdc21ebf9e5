// The directions that a surface point sees as signed distances, and a subset of vertices that suffices.
#pragma once

#include <bitset>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <unordered_map>
#include <vector>

#include "renderer/scene/scene.hpp"
#include "renderer/visibility/occluders.hpp"

namespace footprint {

/// Directions per side of the octahedral visibility grid: 1024 rays per point, about 6 degrees apart.
inline constexpr int visibility_edge = 32;

/// For each direction of the grid, row by row, whether it is unobstructed.
using SphereVisibility = std::bitset<std::size_t{visibility_edge} * visibility_edge>;

/// The directions of the grid, the middles of its cells, unit.
[[nodiscard]] const std::vector<glm::vec3>& visibility_directions();

/// The cell of a direction (of any length but 0).
[[nodiscard]] std::size_t visibility_cell(const glm::dvec3& direction);

/// The visible directions at a surface point: those above the plane of its unit `normal` that no triangle blocks, and
/// all below it with an open horizon. Rays start at the occluders' offset.
[[nodiscard]] SphereVisibility visibility_at(const Occluders& occluders, const glm::vec3& point,
                                             const glm::vec3& normal, Horizon horizon = Horizon::cut);

/// The angle from each unit direction to the nearest edge of the visible region, radians: positive in visible
/// directions, negative in hidden ones. An edge is halfway between two neighbours of the grid. Without an edge: pi if
/// all is visible, -pi if nothing is.
[[nodiscard]] std::vector<float> signed_distances(const SphereVisibility& visible,
                                                  std::span<const glm::vec3> directions);

/// A subset of vertices such that every vertex is within distance 1 of one. The distance of two vertices is sqrt(d^2 /
/// s^2 + (1 - n m) / (1 - cos 20 degrees)), with d between positions, spacing s, and normals n and m.
class VertexSamples {
 public:
  /// spacing: above 0, in units of the positions.
  /// vertices: must outlive this; equal vertices in equal order give equal samples.
  VertexSamples(const std::vector<const Vertex*>& vertices, float spacing);

  [[nodiscard]] const std::vector<const Vertex*>& samples() const { return samples_; }

  /// Calls `add` with each sample within distance 2 of `vertex`, one of those given, and its weight. Weights sum to 1
  /// and follow the inverse distance (Franke and Nielson 1980), so that samples keep their values and none enters
  /// abruptly.
  void interpolate(const Vertex& vertex, const std::function<void(std::size_t sample, float weight)>& add) const;

 private:
  using Cell = std::uint64_t;
  struct Near {
    std::size_t sample;
    float distance;
  };

  [[nodiscard]] glm::ivec3 cell_of(const glm::vec3& position) const;
  [[nodiscard]] std::vector<Near> near(const Vertex& vertex) const;  ///< those within 2

  float spacing_;
  glm::vec3 origin_{0.0F};
  std::vector<const Vertex*> samples_;
  std::unordered_map<Cell, std::vector<std::uint32_t>> grid_;  ///< of cells as wide as the reach
};

}  // namespace footprint
