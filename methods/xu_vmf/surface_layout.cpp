// Covers texels with triangles as a rasteriser does, and packs charts into an atlas where coordinates overlap.
#include "methods/xu_vmf/surface_layout.hpp"
#include "renderer/scene/charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>

namespace footprint::xu_vmf {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

constexpr double tolerance = 1e-2;          // texels by which rounding may move a coordinate over the map's edge
constexpr double permitted_overlap = 1e-3;  // of the covered texels: rounding along shared edges
constexpr double permitted_loss = 1e-3;     // of the surface's area: slivers between the texels
constexpr double thinnest = 1e-3;           // texels; thinner triangles count as lines
constexpr double largest_coordinate = 1e6;  // texels; no layout beyond

// A rectangle of texels, `end` excluded.
struct Box {
  glm::ivec2 first{0}, end{0};
  [[nodiscard]] glm::ivec2 size() const { return end - first; }
};

// Triangles that are connected by vertices, and the texels that they cover.
struct Chart {
  std::vector<Triangle> triangles;
  Box box;
  glm::ivec2 corner{0};  // of its box in the atlas
};

// Counts covered texels, and those covered more than once.
class Coverage {
 public:
  explicit Coverage(const Box& box)
      : box_(box), covered_(static_cast<std::size_t>(box.size().x) * static_cast<std::size_t>(box.size().y)) {}

  // Covers the texels with centres inside, as a rasteriser does: centres on a shared edge belong to one side only.
  void add(std::span<const glm::dvec2, 3> corners) {
    const double area = cross(corners[1] - corners[0], corners[2] - corners[0]);
    if (area == 0.0) return;
    const std::array<glm::dvec2, 3> turned{corners[0], corners[area > 0 ? 1 : 2], corners[area > 0 ? 2 : 1]};
    const glm::dvec2 lower = glm::min(turned[0], glm::min(turned[1], turned[2]));
    const glm::dvec2 upper = glm::max(turned[0], glm::max(turned[1], turned[2]));
    const glm::ivec2 first = glm::max(glm::ivec2(glm::floor(lower)), box_.first);
    const glm::ivec2 end = glm::min(glm::ivec2(glm::floor(upper)) + 1, box_.end);
    for (int y = first.y; y < end.y; ++y) {
      for (int x = first.x; x < end.x; ++x) {
        if (holds(turned, glm::dvec2(x, y) + 0.5)) cover(x, y);
      }
    }
  }

  [[nodiscard]] bool overlaps() const { return twice_ > permitted_overlap * once_; }

  // Whether a fetch in the middle of an added triangle reads a covered texel.
  [[nodiscard]] bool shows(std::span<const glm::dvec2, 3> corners) const {
    double longest = 0;
    for (std::size_t i = 0; i < 3; ++i) longest = std::max(longest, glm::distance(corners[i], corners[(i + 1) % 3]));
    if (std::abs(cross(corners[1] - corners[0], corners[2] - corners[0])) <= thinnest * longest) return false;
    const glm::ivec2 corner(glm::floor((corners[0] + corners[1] + corners[2]) / 3.0 - 0.5));
    for (const glm::ivec2 step : {glm::ivec2(0, 0), glm::ivec2(1, 0), glm::ivec2(0, 1), glm::ivec2(1, 1)}) {
      const glm::ivec2 texel = corner + step;
      const bool inside =
          glm::all(glm::greaterThanEqual(texel, box_.first)) && glm::all(glm::lessThan(texel, box_.end));
      if (inside && covered_[index_of(texel)]) return true;
    }
    return false;
  }

 private:
  static double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

  static bool holds(const std::array<glm::dvec2, 3>& corners, const glm::dvec2& point) {
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::dvec2 from = corners.at(i);
      const glm::dvec2 edge = corners.at((i + 1) % 3) - from;
      const double side = cross(edge, point - from);
      const bool keeps_edge = edge.y > 0.0 || (edge.y == 0.0 && edge.x < 0.0);
      if (side < 0.0 || (side == 0.0 && !keeps_edge)) return false;
    }
    return true;
  }

  [[nodiscard]] std::size_t index_of(const glm::ivec2& texel) const {
    const glm::ivec2 at = texel - box_.first;
    return static_cast<std::size_t>(at.y) * static_cast<std::size_t>(box_.size().x) + static_cast<std::size_t>(at.x);
  }

  void cover(int x, int y) {
    const std::size_t index = index_of({x, y});
    ++(covered_[index] ? twice_ : once_);
    covered_[index] = true;
  }

  Box box_;
  std::vector<bool> covered_;
  double once_ = 0, twice_ = 0;
};

std::vector<glm::dvec2> texel_coordinates(const TriangleSoup& triangles, const TextureCoordinates& coordinates,
                                          const glm::ivec2& size) {
  std::vector<glm::dvec2> out;
  out.reserve(triangles.vertices.size());
  for (const Vertex& vertex : triangles.vertices) {
    const glm::vec2 uv = coordinates.set == 0 ? vertex.uv0 : vertex.uv1;
    out.push_back(glm::dvec2(coordinates.transform * glm::vec3(uv, 1.0F)) * glm::dvec2(size));
  }
  return out;
}

std::array<glm::dvec2, 3> corners_of(const Triangle& triangle, std::span<const glm::dvec2> positions) {
  return {positions[triangle[0]], positions[triangle[1]], positions[triangle[2]]};
}

double surface_area(const Triangle& triangle, std::span<const Vertex> vertices) {
  const glm::dvec3 from(vertices[triangle[0]].position);
  return 0.5 * glm::length(glm::cross(glm::dvec3(vertices[triangle[1]].position) - from,
                                      glm::dvec3(vertices[triangle[2]].position) - from));
}

// The result of drawing triangles at their own coordinates.
struct Drawing {
  bool overlaps;
  double lost;  // area of the surface without texels
};

Drawing draw(std::span<const Triangle> triangles, std::span<const glm::dvec2> positions, const Box& box,
             std::span<const Vertex> vertices) {
  Coverage coverage(box);
  for (const Triangle& triangle : triangles) coverage.add(corners_of(triangle, positions));
  double lost = 0;
  for (const Triangle& triangle : triangles) {
    if (!coverage.shows(corners_of(triangle, positions))) lost += surface_area(triangle, vertices);
  }
  return {coverage.overlaps(), lost};
}

std::vector<Triangle> triangle_list(const TriangleSoup& soup) {
  std::vector<Triangle> out;
  for (std::size_t i = 0; i + 2 < soup.indices.size(); i += 3)
    out.push_back({soup.indices[i], soup.indices[i + 1], soup.indices[i + 2]});
  return out;
}

Box box_of(std::span<const Triangle> triangles, std::span<const glm::dvec2> positions) {
  glm::dvec2 lower(largest_coordinate), upper(-largest_coordinate);
  for (const Triangle& triangle : triangles) {
    for (const std::uint32_t vertex : triangle) {
      lower = glm::min(lower, positions[vertex]);
      upper = glm::max(upper, positions[vertex]);
    }
  }
  return {glm::ivec2(glm::floor(lower + tolerance)), glm::ivec2(glm::ceil(upper - tolerance))};
}

std::vector<Chart> charts_of(std::span<const Triangle> triangles, std::span<const glm::dvec2> positions) {
  VertexGroups groups(positions.size());
  for (const Triangle& triangle : triangles) {
    groups.join(triangle[0], triangle[1]);
    groups.join(triangle[0], triangle[2]);
  }
  std::vector<std::optional<std::size_t>> chart_of(positions.size());
  std::vector<Chart> charts;
  for (const Triangle& triangle : triangles) {
    std::optional<std::size_t>& chart = chart_of[groups.root(triangle[0])];
    if (!chart) {
      chart = charts.size();
      charts.emplace_back();
    }
    charts[*chart].triangles.push_back(triangle);
  }
  for (Chart& chart : charts) {
    chart.box = box_of(chart.triangles, positions);
    chart.box.end = glm::max(chart.box.end, chart.box.first + 1);
  }
  return charts;
}

// Packs charts in shelves, the highest first; the size of the atlas, or none above `largest_atlas` or `longest_side`.
std::optional<glm::ivec2> pack(std::vector<Chart>& charts) {
  double area = 0;
  int widest = 1;
  std::vector<Chart*> order;
  for (Chart& chart : charts) {
    const glm::ivec2 cell = chart.box.size() + chart_gap;
    area += static_cast<double>(cell.x) * cell.y;
    widest = std::max(widest, cell.x);
    order.push_back(&chart);
  }
  if (area > static_cast<double>(largest_atlas)) return {};
  constexpr int multiple = 64;  // even at several levels
  const auto rounded = [](int size) { return (size + multiple - 1) / multiple * multiple; };
  const int width = rounded(std::max(widest, static_cast<int>(std::ceil(std::sqrt(area)))));
  std::ranges::stable_sort(order, std::ranges::greater(), [](const Chart* chart) { return chart->box.size().y; });
  Shelves<int> shelves(width);
  for (Chart* chart : order) chart->corner = shelves.place(chart->box.size() + chart_gap) + chart_gap / 2;
  const glm::ivec2 size(width, rounded(shelves.height()));
  if (std::max(size.x, size.y) > longest_side) return {};
  if (static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) > largest_atlas) return {};
  return size;
}

// Moves every chart to its corner. `positions` change from texels of the map to texels of the atlas.
void move(std::span<const Chart> charts, std::span<glm::dvec2> positions) {
  std::vector<bool> moved(positions.size());
  for (const Chart& chart : charts) {
    for (const Triangle& triangle : chart.triangles) {
      for (const std::uint32_t vertex : triangle) {
        if (!moved[vertex]) positions[vertex] += glm::dvec2(chart.corner - chart.box.first);
        moved[vertex] = true;
      }
    }
  }
}

SurfaceLayout layout(const glm::ivec2& size, std::span<const glm::dvec2> positions, std::string note, bool unique) {
  SurfaceLayout out{.size = size, .coordinates = {}, .unique = unique, .note = std::move(note)};
  out.coordinates.reserve(positions.size());
  for (const glm::dvec2& position : positions) out.coordinates.emplace_back(position / glm::dvec2(size));
  return out;
}

}  // namespace

SurfaceLayout lay_out(const TriangleSoup& soup, const TextureCoordinates& coordinates, const glm::ivec2& map_size) {
  std::vector<glm::dvec2> positions = texel_coordinates(soup, coordinates, map_size);
  const auto none = [&](const std::string& why) {
    return layout(map_size, positions, why + ": joined in the tangent frame", false);
  };
  const bool sound = std::ranges::all_of(positions, [](const glm::dvec2& position) {
    return std::abs(position.x) < largest_coordinate && std::abs(position.y) < largest_coordinate;  // false for NaN
  });
  if (!sound) return none("texture coordinates are not finite, or far outside of the map");
  const std::vector<Triangle> triangles = triangle_list(soup);
  if (triangles.empty()) return layout(map_size, positions, {}, true);
  double area = 0;
  for (const Triangle& triangle : triangles) area += surface_area(triangle, soup.vertices);
  const std::string loses =
      "texture coordinates leave part of the surface without a texel, as where a model has none or they lie on a line";
  const Box map{{0, 0}, map_size};
  const Box used = box_of(triangles, positions);
  const bool inside =
      glm::all(glm::greaterThanEqual(used.first, map.first)) && glm::all(glm::lessThanEqual(used.end, map.end));
  if (inside) {
    const Drawing drawing = draw(triangles, positions, map, soup.vertices);
    if (drawing.lost > permitted_loss * area) return none(loses);
    if (!drawing.overlaps) return layout(map_size, positions, {}, true);
  }
  std::vector<Chart> charts = charts_of(triangles, positions);
  const std::optional<glm::ivec2> size = pack(charts);
  if (!size) {
    return none(fmt::format("an atlas of its own would have more than {} texels, or {} along a side", largest_atlas,
                            longest_side));
  }
  double lost = 0;
  for (const Chart& chart : charts) {
    const Drawing drawing = draw(chart.triangles, positions, chart.box, soup.vertices);
    if (drawing.overlaps) return none("texture coordinates overlap within one chart");
    lost += drawing.lost;
  }
  if (lost > permitted_loss * area) return none(loses);
  move(charts, positions);
  return layout(*size, positions,
                fmt::format("the texture coordinates {}: an atlas of {} x {} texels in {} charts",
                            inside ? "overlap" : "leave the map", size->x, size->y, charts.size()),
                true);
}

}  // namespace footprint::xu_vmf
