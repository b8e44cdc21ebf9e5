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

/// Directions per side of the octahedral grid on which visibility is asked: 1024 rays per point, about 6 degrees apart.
inline constexpr int visibility_edge = 32;

/// For each direction of the grid, row by row, whether nothing lies in it.
using SphereVisibility = std::bitset<std::size_t{visibility_edge} * visibility_edge>;

/// The directions of the grid, the middles of its cells, unit.
[[nodiscard]] const std::vector<glm::vec3>& visibility_directions();

/// The cell that a direction (of any length but 0) lies in.
[[nodiscard]] std::size_t visibility_cell(const glm::dvec3& direction);

/// What a surface point sees: of what is above the plane of its `normal` (unit) what no triangle hides; below it
/// nothing, or with an open horizon all. Rays start before the surface by the occluders' offset.
[[nodiscard]] SphereVisibility visibility_at(const Occluders& occluders, const glm::vec3& point,
                                             const glm::vec3& normal, Horizon horizon = Horizon::cut);

/// The angle from each of `directions` (unit) to the nearest edge between visible and hidden, in radians, -pi to pi:
/// above 0 where the direction is visible, below where it is hidden. An edge lies halfway between two neighbours of
/// the grid. Without an edge: pi where all is visible, -pi where nothing is.
[[nodiscard]] std::vector<float> signed_distances(const SphereVisibility& visible,
                                                  std::span<const glm::vec3> directions);

/// A subset of vertices such that each vertex is within 1 of one: the distance of two vertices is sqrt(d^2 / s^2 + (1 -
/// n m) / (1 - cos 20 degrees)), d between their positions, s the spacing, n and m their normals.
class VertexSamples {
 public:
  /// `spacing` in units of the positions, over 0. Takes vertices in their order, so that equal ones give equal samples.
  /// The vertices must outlive this.
  VertexSamples(const std::vector<const Vertex*>& vertices, float spacing);

  [[nodiscard]] const std::vector<const Vertex*>& samples() const { return samples_; }

  /// Calls `add` with each sample within 2 of `vertex`, one of those given, and its weight; the weights' sum is 1. They
  /// go by inverse distance (Franke and Nielson 1980): a sample has its own value, and none comes into reach abruptly.
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
