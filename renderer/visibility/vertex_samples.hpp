// Vertices that stand for those near them, so that what is asked of a surface does not grow with a mesh's fineness.
#pragma once

#include <cstdint>
#include <functional>
#include <unordered_map>
#include <vector>

#include "renderer/scene/scene.hpp"

namespace footprint {

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
