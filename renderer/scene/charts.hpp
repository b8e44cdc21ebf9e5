// UV islands of a mesh, new texture coordinates that show each point of the surface once; groups of
// connected vertices, and rectangles on shelves.
#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/glm.hpp>
#include <numeric>
#include <span>
#include <vector>

#include "renderer/scene/scene.hpp"

namespace footprint {

/// The charts (UV islands) of a mesh.
struct Charts {
  std::vector<std::uint32_t> of_vertex;  ///< the number of each vertex's chart, below `count`
  std::uint32_t count = 0;
};

/// Triangles that share a vertex are in one chart. Vertices with equal positions and texture coordinates count as one.
/// material: its maps decide which sets of coordinates count.
[[nodiscard]] Charts charts_of(std::span<const Vertex> vertices, std::span<const std::uint32_t> indices,
                               const Material& material);

/// Replaces both sets of texture coordinates so that every triangle has its own part of the unit square, all at one
/// scale. A chart is a connected piece that does not overlap along its axis and leans away from it by at most 60
/// degrees, so lengths shrink to at least a half. Charts are oriented with +y up (-z if level) and packed with gaps of
/// 1/1024. Vertices between charts are split and tangents are computed; positions, normals, and the triangles' order
/// and winding stay. Triangles without area are at (0, 0). Positions must be finite.
void unwrap(Mesh& mesh);

/// Union-find over vertices: connected vertices have one root.
class VertexGroups {
 public:
  explicit VertexGroups(std::size_t count) : parents_(count) { std::iota(parents_.begin(), parents_.end(), 0U); }

  [[nodiscard]] std::uint32_t root(std::uint32_t vertex) {
    while (parents_[vertex] != vertex) vertex = parents_[vertex] = parents_[parents_[vertex]];  // shortens the way
    return vertex;
  }

  void join(std::uint32_t a, std::uint32_t b) { parents_[root(a)] = root(b); }

 private:
  std::vector<std::uint32_t> parents_;
};

/// Shelves of one width, in any unit. Place the highest rectangles first to waste little.
template <class Length>
class Shelves {
 public:
  using Size = glm::vec<2, Length>;

  explicit Shelves(Length width) : width_(width) {}

  /// The lower left corner of the next rectangle; one wider than a shelf gets its own shelf.
  Size place(const Size& size) {
    if (pen_.x > Length{0} && pen_.x + size.x > width_) {
      pen_ = {Length{0}, height()};
      shelf_ = Length{0};
    }
    const Size corner = pen_;
    shelf_ = std::max(shelf_, size.y);
    pen_.x += size.x;
    return corner;
  }

  /// The height of all shelves.
  [[nodiscard]] Length height() const { return pen_.y + shelf_; }

 private:
  Length width_, shelf_{0};
  Size pen_{0};
};

}  // namespace footprint
