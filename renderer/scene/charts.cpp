// Charts are connected pieces of similar normals that do not overlap, packed on shelves.
#include "renderer/scene/charts.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <unordered_map>
#include <utility>

#include "renderer/core/bytes.hpp"
#include "renderer/core/process.hpp"
#include "renderer/scene/geometry.hpp"
#include "renderer/scene/tangents.hpp"

namespace footprint {
namespace {

// Returns which of the two sets of texture coordinates the maps of a material read.
std::array<bool, 2> sets_read_by(const Material& material) {
  std::array<bool, 2> read{};
  for (const TextureMap* map : maps_of(material)) read.at(static_cast<std::size_t>(map->coordinates.set)) = true;
  if (material.share) read.at(static_cast<std::size_t>(material.share->map.coordinates.set)) = true;
  return read;
}

// Position and coordinates, bit by bit; 0 and -0 are one.
using Key = std::array<std::uint32_t, 7>;

struct KeyHash {
  std::size_t operator()(const Key& key) const { return fnv1a(std::as_bytes(std::span(key))); }
};

std::uint32_t bits(float value) { return std::bit_cast<std::uint32_t>(value == 0.0F ? 0.0F : value); }

Key key_of(const Vertex& v, const std::array<bool, 2>& sets) {
  const glm::vec2 uv0 = sets[0] ? v.uv0 : glm::vec2(0.0F);
  const glm::vec2 uv1 = sets[1] ? v.uv1 : glm::vec2(0.0F);
  return {bits(v.position.x), bits(v.position.y), bits(v.position.z), bits(uv0.x),
          bits(uv0.y),        bits(uv1.x),        bits(uv1.y)};
}

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

/// The least cosine between a triangle's normal and its chart's axis.
constexpr double least_facing = 0.5;

/// The gap around a chart, as a share of the packed square's side.
constexpr double gap = 1.0 / 1024.0;

using FlatTriangle = std::array<glm::dvec2, 3>;

/// Whether the insides of two triangles share a point: no edge of either has the other wholly on its far side, but for
/// what rounding of positions and cracks between patches of a mesh amount to.
bool overlap(const FlatTriangle& a, const FlatTriangle& b) {
  const auto is_apart = [](const FlatTriangle& from, const FlatTriangle& other) {
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::dvec2 edge = from[(i + 1) % 3] - from[i],
                       normal{edge.y, -edge.x};  // outwards of a triangle that turns left
      const double tolerance = 1e-5 * glm::dot(edge, edge);
      const bool beyond = std::ranges::all_of(
          other, [&](const glm::dvec2& corner) { return glm::dot(corner - from[i], normal) >= -tolerance; });
      if (beyond) return true;
    }
    return false;
  };
  return !is_apart(a, b) && !is_apart(b, a);
}

/// The axes of the plane that a chart is laid flat on: right, and up.
struct Plane {
  explicit Plane(const glm::dvec3& axis) {
    const glm::dvec3 upwards = std::abs(axis.y) < 0.9 ? glm::dvec3{0.0, 1.0, 0.0} : glm::dvec3{0.0, 0.0, -axis.y};
    right = glm::normalize(glm::cross(upwards, axis));
    up = glm::cross(axis, right);
  }
  [[nodiscard]] glm::dvec2 flat(const glm::dvec3& point) const { return {glm::dot(point, right), glm::dot(point, up)}; }
  glm::dvec3 right, up;
};

/// What a growing chart covers, in square cells.
class CoveredCells {
 public:
  explicit CoveredCells(double cell) : cell_(cell) {}

  /// Adds a triangle unless it overlaps one that is there.
  bool add(const FlatTriangle& triangle) {
    const auto cells = cells_of(triangle);
    for (const std::uint64_t cell : cells) {
      const auto found = cells_.find(cell);
      if (found == cells_.end()) continue;
      const auto hit = [&](std::size_t i) { return overlap(triangle, triangles_[i]); };
      if (std::ranges::any_of(found->second, hit)) return false;
    }
    for (const std::uint64_t cell : cells) cells_[cell].push_back(triangles_.size());
    triangles_.push_back(triangle);
    return true;
  }

 private:
  [[nodiscard]] std::vector<std::uint64_t> cells_of(const FlatTriangle& triangle) const {
    const glm::dvec2 low = glm::floor(glm::min(glm::min(triangle[0], triangle[1]), triangle[2]) / cell_);
    const glm::dvec2 high = glm::floor(glm::max(glm::max(triangle[0], triangle[1]), triangle[2]) / cell_);
    std::vector<std::uint64_t> cells;
    for (double y = low.y; y <= high.y; ++y) {
      for (double x = low.x; x <= high.x; ++x) {
        cells.push_back(static_cast<std::uint64_t>(static_cast<std::int32_t>(x)) << 32U |
                        static_cast<std::uint32_t>(static_cast<std::int32_t>(y)));
      }
    }
    return cells;
  }

  double cell_;
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> cells_;
  std::vector<FlatTriangle> triangles_;
};

struct Chart {
  Plane plane;
  std::vector<std::uint32_t> triangles;
  glm::dvec2 low{0.0}, size{0.0};  ///< its bounds on the plane
  glm::dvec2 corner{0.0};          ///< its lower left corner where it is packed
};

/// Cuts a mesh into charts.
class ChartCutter {
 public:
  explicit ChartCutter(const Mesh& mesh)
      : mesh_(mesh), taken_(mesh.indices.size() / 3, false), seen_(taken_.size(), 0) {
    find_normals();
    find_neighbours();
  }

  /// The charts; triangles without area are in none.
  std::vector<Chart> cut() {
    std::vector<Chart> charts;
    for (std::uint32_t seed = 0; seed < taken_.size(); ++seed) {
      if (taken_[seed]) continue;
      throw_if_interrupted();
      // Twice: around the seed's normal, then around the mean of what that reached.
      glm::dvec3 mean{0.0};
      for (const std::uint32_t triangle : grow(seed, axis_of(area_normals_[seed]))) mean += area_normals_[triangle];
      const glm::dvec3 axis = axis_of(mean);
      charts.push_back({.plane = Plane(axis), .triangles = grow(seed, axis)});
      for (const std::uint32_t triangle : charts.back().triangles) taken_[triangle] = true;
    }
    return charts;
  }

 private:
  static glm::dvec3 axis_of(const glm::dvec3& area_normal) {
    const double length = glm::length(area_normal);
    return length > 0.0 && std::isfinite(1.0 / length) ? area_normal / length : glm::dvec3{0.0, 0.0, 1.0};
  }

  [[nodiscard]] const glm::vec3& corner(std::size_t index) const {
    return mesh_.vertices[mesh_.indices[index]].position;
  }

  void find_normals() {
    glm::vec3 low = corner(0), high = low;
    for (const Vertex& vertex : mesh_.vertices) {
      low = glm::min(low, vertex.position);
      high = glm::max(high, vertex.position);
    }
    double edges = 0.0;
    for (std::size_t i = 0; i < mesh_.indices.size(); i += 3) {
      const glm::dvec3 a{corner(i)}, b{corner(i + 1)}, c{corner(i + 2)};
      area_normals_.push_back(glm::cross(b - a, c - a));
      taken_[i / 3] = area_normals_.back() == glm::dvec3{0.0};
      edges += glm::length(b - a);
    }
    // Some triangles a cell; but a large triangle among tiny ones must not lie in millions of cells.
    const double extent = glm::length(glm::dvec3{high} - glm::dvec3{low});
    origin_ = low;
    cell_ = std::max(2.0 * edges / static_cast<double>(area_normals_.size()), extent / 256.0);
    if (!(cell_ > 0.0)) cell_ = 1.0;
  }

  /// Triangles beside each other share two positions; an edge of more than two triangles joins none of them.
  void find_neighbours() {
    using Position = std::array<float, 3>;
    std::map<Position, std::uint32_t> known;
    std::vector<std::uint32_t> position_of;
    for (const Vertex& vertex : mesh_.vertices) {
      const Position position{vertex.position.x, vertex.position.y, vertex.position.z};
      position_of.push_back(known.emplace(position, static_cast<std::uint32_t>(known.size())).first->second);
    }
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::size_t>> edges;
    for (std::size_t i = 0; i < mesh_.indices.size(); ++i) {
      if (taken_[i / 3]) continue;  // without area it is on an edge of others
      const std::uint32_t a = position_of[mesh_.indices[i]];
      const std::uint32_t b = position_of[mesh_.indices[i / 3 * 3 + (i + 1) % 3]];
      edges[std::minmax(a, b)].push_back(i);
    }
    neighbours_.assign(mesh_.indices.size(), none);
    for (const auto& [edge, sides] : edges) {
      if (sides.size() != 2) continue;
      neighbours_[sides[0]] = static_cast<std::uint32_t>(sides[1] / 3);
      neighbours_[sides[1]] = static_cast<std::uint32_t>(sides[0] / 3);
    }
  }

  /// The triangles around `seed`, and it, that face `axis` and lie side by side seen along it, nearest ones first.
  [[nodiscard]] std::vector<std::uint32_t> grow(std::uint32_t seed, const glm::dvec3& axis) {
    const Plane plane(axis);
    CoveredCells covered(cell_);
    std::vector<std::uint32_t> chart{seed};
    seen_[seed] = ++growths_;
    covered.add(flat(seed, plane));
    for (std::size_t next = 0; next < chart.size(); ++next) {
      for (std::size_t side = 0; side < 3; ++side) {
        const std::uint32_t beside = neighbours_[3 * static_cast<std::size_t>(chart[next]) + side];
        if (beside == none || taken_[beside] || seen_[beside] == growths_) continue;
        seen_[beside] = growths_;
        const glm::dvec3& normal = area_normals_[beside];
        if (glm::dot(normal, axis) < least_facing * glm::length(normal)) continue;
        if (covered.add(flat(beside, plane))) chart.push_back(beside);
      }
    }
    return chart;
  }

  [[nodiscard]] FlatTriangle flat(std::uint32_t triangle, const Plane& plane) const {
    const std::size_t first = 3 * static_cast<std::size_t>(triangle);
    const auto flat = [&](std::size_t index) { return plane.flat(glm::dvec3{corner(index)} - glm::dvec3{origin_}); };
    return {flat(first), flat(first + 1), flat(first + 2)};
  }

  const Mesh& mesh_;
  std::vector<bool> taken_;          ///< whether a triangle is in a chart yet
  std::vector<std::uint64_t> seen_;  ///< the last growth that looked at a triangle
  std::uint64_t growths_ = 0;
  std::vector<glm::dvec3> area_normals_;
  std::vector<std::uint32_t> neighbours_;  ///< beside each side of each triangle
  glm::vec3 origin_{0.0F};                 ///< cells are counted from here
  double cell_ = 1.0;
};

/// Puts charts, the highest first, side by side on shelves of `width`, each with `margin` around it. Returns the height
/// that they take.
double pack_shelves(std::span<Chart*> by_height, double width, double margin) {
  Shelves<double> shelves(width);
  for (Chart* chart : by_height) chart->corner = shelves.place(chart->size + 2.0 * margin) + margin;
  return shelves.height();
}

/// Packs charts into a square and returns its side.
double pack(std::vector<Chart>& charts) {
  std::vector<Chart*> by_height;
  double area = 0.0, widest = 0.0;
  for (Chart& chart : charts) {
    by_height.push_back(&chart);
    area += chart.size.x * chart.size.y;
    widest = std::max({widest, chart.size.x, chart.size.y});
  }
  std::ranges::stable_sort(by_height, std::ranges::greater{}, [](const Chart* chart) { return chart->size.y; });
  // The smallest side, within 1%, that takes them all.
  double side = std::max({std::sqrt(area), widest / (1.0 - 2.0 * gap), 1e-30});
  while (pack_shelves(by_height, side, gap * side) > side) side *= 1.01;
  return side;
}

void find_bounds(const Mesh& mesh, Chart& chart) {
  glm::dvec2 low{std::numeric_limits<double>::max()}, high{std::numeric_limits<double>::lowest()};
  for (const std::uint32_t triangle : chart.triangles) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Vertex& vertex = mesh.vertices[mesh.indices[3 * std::size_t{triangle} + corner]];
      const glm::dvec2 point = chart.plane.flat(glm::dvec3{vertex.position});
      low = glm::min(low, point);
      high = glm::max(high, point);
    }
  }
  chart.low = low;
  chart.size = high - low;
}

/// Gives every chart that meets at a vertex a vertex of its own there, with its position in the square as uv.
/// What no chart has stays at (0, 0).
void lay_out(std::vector<Chart> charts, Mesh& mesh) {
  for (Chart& chart : charts) find_bounds(mesh, chart);
  const double side = pack(charts);
  for (Vertex& vertex : mesh.vertices) vertex.uv0 = vertex.uv1 = glm::vec2{0.0F};
  std::vector<std::pair<const Chart*, std::uint32_t>> latest(mesh.vertices.size(), {nullptr, none});
  for (const Chart& chart : charts) {
    for (const std::uint32_t triangle : chart.triangles) {
      for (std::size_t corner = 0; corner < 3; ++corner) {
        std::uint32_t& index = mesh.indices[3 * std::size_t{triangle} + corner];
        auto& [latest_chart, copy] = latest[index];
        if (latest_chart != &chart) {
          Vertex vertex = mesh.vertices[index];
          const glm::dvec2 on_plane = chart.plane.flat(glm::dvec3{vertex.position}) - chart.low;
          const glm::dvec2 on_square = (on_plane + chart.corner) / side;
          vertex.uv0 = vertex.uv1 = glm::vec2{on_square.x, 1.0 - on_square.y};
          latest_chart = &chart;
          copy = static_cast<std::uint32_t>(mesh.vertices.size());
          mesh.vertices.push_back(vertex);
        }
        index = copy;
      }
    }
  }
  drop_unused_vertices(mesh.vertices, mesh.indices);
}

}  // namespace

Charts charts_of(std::span<const Vertex> vertices, std::span<const std::uint32_t> indices, const Material& material) {
  const std::array<bool, 2> sets = sets_read_by(material);
  VertexGroups groups(vertices.size());
  std::unordered_map<Key, std::uint32_t, KeyHash> seen;
  for (std::uint32_t i = 0; i < vertices.size(); ++i)
    groups.join(i, seen.try_emplace(key_of(vertices[i], sets), i).first->second);
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    groups.join(indices[i], indices[i + 1]);
    groups.join(indices[i], indices[i + 2]);
  }
  Charts charts;
  std::unordered_map<std::uint32_t, std::uint32_t> numbers;  // of roots, in the order of the first vertex
  for (std::uint32_t i = 0; i < vertices.size(); ++i) {
    const auto [number, is_new] = numbers.try_emplace(groups.root(i), charts.count);
    charts.count += is_new ? 1 : 0;
    charts.of_vertex.push_back(number->second);
  }
  return charts;
}

void unwrap(Mesh& mesh) {
  if (mesh.indices.empty()) return;
  lay_out(ChartCutter(mesh).cut(), mesh);
  compute_tangents(mesh.vertices, mesh.indices, {});
}

}  // namespace footprint
