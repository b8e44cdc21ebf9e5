// Welds equal vertices, groups the corners around each, and sums the tangents of their triangles.
#include "renderer/scene/tangents.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "renderer/core/bytes.hpp"
#include "renderer/scene/geometry.hpp"

namespace footprint {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

const glm::vec2& coordinates_of(const Vertex& vertex, int set) { return set == 1 ? vertex.uv1 : vertex.uv0; }

/// The place at which a map with `coordinates` is looked up for a vertex.
glm::vec2 map_position(const Vertex& vertex, const TextureCoordinates& coordinates) {
  return coordinates.transform * glm::vec3{coordinates_of(vertex, coordinates.set), 1.0F};
}

glm::dvec3 unit_normal(const Vertex& vertex) { return unit_or(glm::dvec3{vertex.normal}, glm::dvec3{0.0}); }

/// Any unit vector perpendicular to a unit vector.
glm::vec3 any_perpendicular(const glm::vec3& unit) {
  const glm::vec3 axis = std::abs(unit.x) < 0.9F ? glm::vec3{1.0F, 0.0F, 0.0F} : glm::vec3{0.0F, 1.0F, 0.0F};
  return glm::normalize(axis - unit * glm::dot(unit, axis));
}

/// The normalised part of `vector` perpendicular to the unit `normal`; zero if there is none.
glm::dvec3 in_tangent_plane(const glm::dvec3& vector, const glm::dvec3& normal) {
  const glm::dvec3 direction = unit_or(vector, glm::dvec3{0.0});
  const glm::dvec3 flat = direction - normal * glm::dot(normal, direction);
  // Parallel up to rounding: the rest is noise.
  return glm::length(flat) > 1e-6 ? glm::normalize(flat) : glm::dvec3{0.0};
}

bool has_direction(const glm::dvec3& unit_or_zero) { return glm::dot(unit_or_zero, unit_or_zero) > 0.5; }

/// d position / d u of a triangle and the handedness of its texture coordinates; handedness 0 where they are
/// degenerate.
struct TriangleFrame {
  glm::dvec3 tangent{0.0};
  int handedness = 0;
};

TriangleFrame triangle_frame(const std::array<const Vertex*, 3>& corners, const TextureCoordinates& coordinates) {
  const glm::dvec3 p0{corners[0]->position};
  const glm::dvec3 edge1 = glm::dvec3{corners[1]->position} - p0;
  const glm::dvec3 edge2 = glm::dvec3{corners[2]->position} - p0;
  const glm::dvec2 t0{map_position(*corners[0], coordinates)};
  const glm::dvec2 uv1 = glm::dvec2{map_position(*corners[1], coordinates)} - t0;
  const glm::dvec2 uv2 = glm::dvec2{map_position(*corners[2], coordinates)} - t0;
  const double area = uv1.x * uv2.y - uv2.x * uv1.y;
  const double scale = glm::length(uv1) * glm::length(uv2);
  // Collinear to the rounding of float coordinates: the direction of u is noise.
  if (!std::isfinite(scale) || std::abs(area) <= 1e-7 * scale) return {};
  const double sign = area > 0.0 ? 1.0 : -1.0;
  // Counter-clockwise triangles with v downwards have a negative area: those are the unmirrored ones.
  return {sign * (edge1 * uv2.y - edge2 * uv1.y), area > 0.0 ? -1 : 1};
}

/// Finds equal vertices by a hash table of their values.
class Welder {
 public:
  Welder(std::span<const Vertex> vertices, int set)
      : vertices_(vertices), set_(set), table_(std::bit_ceil(2 * vertices.size() + 1), none) {}

  /// The first vertex with the values of `vertex`.
  [[nodiscard]] std::uint32_t first_equal(std::uint32_t vertex) {
    const Values own = values(vertex);
    std::size_t slot = fnv1a(std::as_bytes(std::span(own))) & (table_.size() - 1);
    while (table_[slot] != none && values(table_[slot]) != own) slot = (slot + 1) & (table_.size() - 1);
    if (table_[slot] == none) table_[slot] = vertex;
    return table_[slot];
  }

 private:
  using Values = std::array<std::uint32_t, 8>;

  [[nodiscard]] Values values(std::uint32_t vertex) const {
    const Vertex& v = vertices_[vertex];
    const glm::vec2& uv = coordinates_of(v, set_);
    Values bits{};
    const std::array<float, 8> numbers{v.position.x, v.position.y, v.position.z, v.normal.x,
                                       v.normal.y,   v.normal.z,   uv.x,         uv.y};
    // -0 equals 0.
    std::ranges::transform(numbers, bits.begin(), [](float x) { return std::bit_cast<std::uint32_t>(x + 0.0F); });
    return bits;
  }

  std::span<const Vertex> vertices_;
  int set_;
  std::vector<std::uint32_t> table_;
};

/// The corners of triangles by the welded vertex that they meet in. Corner 3 t + k is corner k of triangle t.
class Corners {
 public:
  Corners(std::span<const Vertex> vertices, std::span<const std::uint32_t> indices, int set)
      : vertex_(indices.size() / 3 * 3), start_(vertices.size() + 1, 0), around_(vertex_.size()) {
    Welder welder(vertices, set);
    for (std::size_t c = 0; c < vertex_.size(); ++c) ++start_[(vertex_[c] = welder.first_equal(indices[c])) + 1];
    for (std::size_t v = 0; v + 1 < start_.size(); ++v) start_[v + 1] += start_[v];
    std::vector<std::uint32_t> next(start_.begin(), start_.end() - 1);
    for (std::uint32_t c = 0; c < vertex_.size(); ++c) around_[next[vertex_[c]]++] = c;
  }

  [[nodiscard]] std::size_t vertex_count() const { return start_.size() - 1; }
  /// The corners at a vertex in the order of triangles; none if it is welded to an earlier one.
  [[nodiscard]] std::span<const std::uint32_t> around(std::size_t vertex) const {
    return std::span(around_).subspan(start_[vertex], start_[vertex + 1] - start_[vertex]);
  }
  /// The vertex of the next corner but `steps` - 1 in the same triangle.
  [[nodiscard]] std::uint32_t vertex_after(std::uint32_t corner, std::uint32_t steps) const {
    return vertex_[corner - corner % 3 + (corner + steps) % 3];
  }

 private:
  std::vector<std::uint32_t> vertex_, start_, around_;
};

/// For each corner around a vertex, the ones whose triangles it meets in an edge: its place in the list, or none. An
/// edge joins two triangles that pass it in opposite directions, in their order if there are more.
std::vector<std::array<std::uint32_t, 2>> neighbours(const Corners& corners, std::span<const std::uint32_t> around) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> by_last;  // the vertex before a corner, and its place
  for (std::uint32_t i = 0; i < around.size(); ++i) by_last.emplace_back(corners.vertex_after(around[i], 2), i);
  std::ranges::sort(by_last);
  std::vector<std::uint32_t> taken(around.size(), 0);  // by the first place of a vertex in `by_last`
  std::vector<std::array<std::uint32_t, 2>> found(around.size(), {none, none});
  for (std::uint32_t i = 0; i < around.size(); ++i) {
    const std::uint32_t next = corners.vertex_after(around[i], 1);
    const auto first = std::ranges::lower_bound(by_last, std::pair{next, std::uint32_t{0}}) - by_last.begin();
    const auto at = static_cast<std::size_t>(first);
    if (at == by_last.size()) continue;
    const std::size_t other = at + taken[at];
    if (other == by_last.size() || by_last[other].first != next) continue;
    ++taken[at];
    found[i][0] = by_last[other].second;
    found[by_last[other].second][1] = i;
  }
  return found;
}

/// Corners around a vertex that share a tangent.
struct Group {
  std::vector<std::uint32_t> corners;  ///< in the order of triangles
  int handedness = 0;                  ///< 0: no triangle has one
};

/// The triangles of a mesh as the algorithm sees them.
class TangentSpace {
 public:
  /// All arguments must outlive this. Splitting vertices, and new tangents, change none of its results.
  TangentSpace(const std::vector<Vertex>& vertices, const std::vector<std::uint32_t>& indices,
               const TextureCoordinates& coordinates)
      : vertices_(vertices), indices_(indices), coordinates_(coordinates) {}

  /// 0 also for triangles without area between two of their corners, which join no group of their own.
  [[nodiscard]] int handedness(std::uint32_t corner) const {
    const auto at = corners_of(corner);
    if (at[0]->position == at[1]->position || at[1]->position == at[2]->position || at[2]->position == at[0]->position)
      return 0;
    return triangle_frame(at, coordinates_).handedness;
  }

  /// The unit tangent of a group for a map with `coordinates`; zero if there is none.
  [[nodiscard]] glm::dvec3 tangent(const Group& group, const TextureCoordinates& coordinates) const {
    const glm::dvec3 normal = unit_normal(vertices_[indices_[group.corners.front()]]);
    glm::dvec3 sum{0.0};
    for (const std::uint32_t corner : group.corners) {
      if (handedness(corner) == 0) continue;
      const glm::dvec3 own = triangle_frame(corners_of(corner), coordinates).tangent;
      sum += angle(corner, normal) * in_tangent_plane(own, normal);
    }
    return in_tangent_plane(sum, normal);
  }

 private:
  [[nodiscard]] std::array<const Vertex*, 3> corners_of(std::uint32_t corner) const {
    const std::uint32_t first = corner - corner % 3;
    return {&vertices_[indices_[first]], &vertices_[indices_[first + 1]], &vertices_[indices_[first + 2]]};
  }

  /// Between the edges at a corner, projected onto the plane of its normal.
  [[nodiscard]] double angle(std::uint32_t corner, const glm::dvec3& normal) const {
    const auto at = corners_of(corner);
    const glm::dvec3 own{at[corner % 3]->position};
    const auto edge = [&](std::uint32_t steps) {
      return in_tangent_plane(glm::dvec3{at[(corner + steps) % 3]->position} - own, normal);
    };
    return std::acos(std::clamp(glm::dot(edge(1), edge(2)), -1.0, 1.0));
  }

  const std::vector<Vertex>& vertices_;
  const std::vector<std::uint32_t>& indices_;
  const TextureCoordinates& coordinates_;
};

/// The groups of corners around a vertex: those of one handedness that meet in edges. Corners without a handedness join
/// the first group that reaches them, and the first of all if none does.
std::vector<Group> groups_around(const Corners& corners, std::span<const std::uint32_t> around,
                                 const TangentSpace& space) {
  const auto beside = neighbours(corners, around);
  std::vector<int> handedness(around.size());
  std::ranges::transform(around, handedness.begin(), [&](std::uint32_t corner) { return space.handedness(corner); });
  std::vector<std::uint32_t> group_of(around.size(), none);
  std::vector<Group> groups;
  for (std::uint32_t seed = 0; seed < around.size(); ++seed) {
    if (group_of[seed] != none || handedness[seed] == 0) continue;
    const auto number = static_cast<std::uint32_t>(groups.size());
    groups.push_back({.corners = {}, .handedness = handedness[seed]});
    std::vector<std::uint32_t> reached{seed};
    group_of[seed] = number;
    while (!reached.empty()) {
      const std::uint32_t i = reached.back();
      reached.pop_back();
      for (const std::uint32_t other : beside[i]) {
        if (other == none || group_of[other] != none) continue;
        if (handedness[other] != 0 && handedness[other] != handedness[seed]) continue;
        group_of[other] = number;
        reached.push_back(other);
      }
    }
  }
  if (groups.empty()) groups.emplace_back();
  for (std::uint32_t i = 0; i < around.size(); ++i)
    groups[group_of[i] == none ? 0 : group_of[i]].corners.push_back(around[i]);
  return groups;
}

/// Calls `visit` with the groups around each vertex that has corners.
template <class Visit>
void for_each_vertex(const std::vector<Vertex>& vertices, const std::vector<std::uint32_t>& indices,
                     const TangentSpace& space, int set, const Visit& visit) {
  const Corners corners(vertices, indices, set);
  for (std::size_t v = 0; v < corners.vertex_count(); ++v) {
    if (!corners.around(v).empty()) visit(groups_around(corners, corners.around(v), space));
  }
}

/// Gives each group the vertices of its corners. A vertex that an earlier group has is copied.
void take_apart(const std::vector<Group>& groups, std::vector<Vertex>& vertices, std::vector<std::uint32_t>& indices) {
  std::map<std::uint32_t, std::size_t> owners;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    std::map<std::uint32_t, std::uint32_t> copies;
    for (const std::uint32_t corner : groups[g].corners) {
      const std::uint32_t own = indices[corner];
      if (owners.emplace(own, g).first->second == g) continue;
      const auto [copy, is_new] = copies.emplace(own, static_cast<std::uint32_t>(vertices.size()));
      if (is_new) vertices.push_back(Vertex{vertices[own]});
      indices[corner] = copy->second;
    }
  }
}

/// Turns a tangent by an angle about a normal.
glm::vec3 turned(const glm::dvec3& tangent, const glm::dvec3& normal, const glm::dvec2& cos_sin) {
  return glm::vec3{cos_sin.x * tangent + cos_sin.y * glm::cross(normal, tangent)};
}

/// Whether a transform leaves the directions of u and v.
bool keeps_directions(const glm::dmat2& linear) {
  return linear[0].x > 0.0 && linear[1].y > 0.0 && linear[0].y == 0.0 && linear[1].x == 0.0;
}

/// Cosine and sine of the turn where texels are square, for triangles whose coordinates do not tell. v runs against the
/// bitangent.
glm::dvec2 turn_on_square_texels(const glm::dmat2& linear, float handedness) {
  const glm::dvec2 direction = glm::normalize(glm::dvec2{linear[1].y, -linear[0].y});  // of the new u, up to its sign
  const double sign = glm::determinant(linear) > 0.0 ? 1.0 : -1.0;
  return sign * glm::dvec2{direction.x, handedness < 0.0F ? direction.y : -direction.y};
}

}  // namespace

std::size_t repair_tangents(std::span<Vertex> vertices) {
  std::size_t count = 0;
  for (Vertex& vertex : vertices) {
    const glm::dvec3 tangent = in_tangent_plane(glm::dvec3{vertex.tangent}, glm::dvec3{vertex.normal});
    const bool valid = has_direction(tangent);
    count += valid ? 0 : 1;
    vertex.tangent = {valid ? glm::vec3{tangent} : any_perpendicular(vertex.normal),
                      vertex.tangent.w < 0.0F ? -1.0F : 1.0F};
  }
  return count;
}

void compute_tangents(std::vector<Vertex>& vertices, std::vector<std::uint32_t>& indices,
                      const TextureCoordinates& coordinates) {
  const TangentSpace space(vertices, indices, coordinates);
  for_each_vertex(vertices, indices, space, coordinates.set, [&](const std::vector<Group>& groups) {
    if (groups.size() > 1) take_apart(groups, vertices, indices);
    for (const Group& group : groups) {
      const glm::dvec3 tangent = space.tangent(group, coordinates);
      const glm::vec3 normal{unit_normal(vertices[indices[group.corners.front()]])};
      const glm::vec3 direction = has_direction(tangent) ? glm::vec3{tangent} : any_perpendicular(normal);
      for (const std::uint32_t corner : group.corners)
        vertices[indices[corner]].tangent = {direction, group.handedness < 0 ? -1.0F : 1.0F};
    }
  });
}

void turn_tangents(std::vector<Vertex>& vertices, const std::vector<std::uint32_t>& indices,
                   const TextureCoordinates& coordinates) {
  const glm::dmat2 linear{glm::dvec2{coordinates.transform[0]}, glm::dvec2{coordinates.transform[1]}};
  const double area = glm::determinant(linear);
  if (keeps_directions(linear) || area == 0.0) return;
  TextureCoordinates plain = coordinates;
  plain.transform = TextureCoordinates{}.transform;
  const TangentSpace space(vertices, indices, plain);
  std::vector<bool> done(vertices.size(), false);
  for_each_vertex(vertices, indices, space, coordinates.set, [&](const std::vector<Group>& groups) {
    for (const Group& group : groups) {
      const glm::dvec3 normal = unit_normal(vertices[indices[group.corners.front()]]);
      const glm::dvec3 from = space.tangent(group, plain), to = space.tangent(group, coordinates);
      const bool known = has_direction(from) && has_direction(to);
      for (const std::uint32_t corner : group.corners) {
        if (done[indices[corner]]) continue;
        done[indices[corner]] = true;
        glm::vec4& tangent = vertices[indices[corner]].tangent;
        const glm::dvec2 turn = known ? glm::dvec2{glm::dot(from, to), glm::dot(glm::cross(normal, from), to)}
                                      : turn_on_square_texels(linear, tangent.w);
        tangent = {turned(in_tangent_plane(glm::dvec3{tangent}, normal), normal, turn),
                   area < 0.0 ? -tangent.w : tangent.w};
      }
    }
  });
}

}  // namespace footprint
