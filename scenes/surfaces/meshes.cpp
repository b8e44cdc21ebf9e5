// Grids of vertices whose tangents and normals are derivatives of their positions. A turned solid has a grid for each
// line or arc of its profile, without the triangles that are pinched to nothing.
#include "scenes/surfaces/meshes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/scene/geometry.hpp"

namespace footprint {
namespace {

using std::numbers::pi;

/// Largest angle between two rows of an arc.
constexpr double widest_turn = pi / 10.0;

/// A point of a profile as a formula.
struct ProfilePoint {
  Height radius, height;
};

/// The angle of an arc, and the length of a cut.
double arc_angle(const Cut& cut) { return 4.0 * std::atan(cut.bulge); }

double cut_length(const glm::dvec2& from, const Cut& cut) {
  const double chord = glm::distance(from, cut.to), half = 0.5 * arc_angle(cut);
  return cut.bulge == 0.0 ? chord : chord * half / std::sin(half);
}

/// The point at a share of the way along a cut.
ProfilePoint along(const glm::dvec2& from, const Cut& cut, const Height& share) {
  const glm::dvec2 chord = cut.to - from;
  if (cut.bulge == 0.0) return {from.x + chord.x * share, from.y + chord.y * share};
  // The centre is to the left of the chord of an arc that bulges to the right.
  const double aside = (1.0 - cut.bulge * cut.bulge) / (4.0 * cut.bulge);
  const glm::dvec2 center = 0.5 * (from + cut.to) + aside * glm::dvec2(-chord.y, chord.x);
  const glm::dvec2 spoke = from - center;
  const Height turn = arc_angle(cut) * share, c = cos(turn), s = sin(turn);
  return {center.x + spoke.x * c - spoke.y * s, center.y + spoke.x * s + spoke.y * c};
}

/// Whether two corners of a triangle coincide.
bool is_pinched(const Mesh& mesh, std::size_t first) {
  const auto corner = [&](std::size_t i) { return mesh.vertices[mesh.indices[first + i % 3]].position; };
  float shortest = glm::distance(corner(0), corner(1)), longest = shortest;
  for (std::size_t i = 1; i < 3; ++i) {
    const float side = glm::distance(corner(i), corner(i + 1));
    shortest = std::min(shortest, side);
    longest = std::max(longest, side);
  }
  return shortest < 1e-4F * longest;
}

}  // namespace

Vertex bent_vertex(const BentPoint& point, const glm::dvec2& uv) {
  const auto along = [&](int axis) {
    return glm::dvec3{point.x.derivatives()[axis], point.y.derivatives()[axis], point.z.derivatives()[axis]};
  };
  Vertex vertex;
  vertex.position = glm::dvec3{point.x.value(), point.y.value(), point.z.value()};
  vertex.tangent = {glm::vec3{glm::normalize(along(0))}, 1.0F};
  vertex.normal = glm::normalize(glm::cross(along(0), along(1)));
  vertex.uv0 = vertex.uv1 = glm::vec2{uv};
  return vertex;
}

Mesh square_mesh(const SurfaceSettings& /*settings*/) { return make_plane({2.0F, 2.0F}, {1.0F, 1.0F}); }

Mesh grid_mesh(int columns, int rows, const std::function<Vertex(const glm::dvec2& st)>& vertex_at) {
  Mesh mesh;
  for (int row = 0; row <= rows; ++row) {
    for (int column = 0; column <= columns; ++column) {
      mesh.vertices.push_back(vertex_at({static_cast<double>(column) / columns, static_cast<double>(row) / rows}));
    }
  }
  const auto at = [&](int column, int row) { return static_cast<std::uint32_t>(row * (columns + 1) + column); };
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const std::uint32_t low_left = at(column, row), low_right = at(column + 1, row);
      const std::uint32_t high_left = at(column, row + 1), high_right = at(column + 1, row + 1);
      mesh.indices.insert(mesh.indices.end(), {low_left, low_right, high_right, low_left, high_right, high_left});
    }
  }
  return mesh;
}

Mesh pinched_grid_mesh(int columns, int rows, const std::function<BentPoint(const HeightPoint&)>& point,
                       const std::function<glm::dvec2(const glm::dvec2&)>& uv_of) {
  // This close to its end, a row still has a direction, but no visible length.
  constexpr double end = 1e-6;
  const Mesh grid = grid_mesh(columns, rows, [&](const glm::dvec2& st) {
    return bent_vertex(point(HeightPoint{{st.x, std::clamp(st.y, end, 1.0 - end)}}), uv_of(st));
  });
  Mesh mesh = grid;
  mesh.indices.clear();
  for (std::size_t i = 0; i < grid.indices.size(); i += 3) {
    if (!is_pinched(grid, i)) mesh.indices.insert(mesh.indices.end(), &grid.indices[i], &grid.indices[i] + 3);
  }
  return mesh;
}

Mesh turned_mesh(const Profile& profile, int columns, double row) {
  double whole = 0.0;
  glm::dvec2 from(0.0, profile.start);
  for (const Cut& cut : profile.cuts) {
    whole += cut_length(from, cut);
    from = cut.to;
  }
  Mesh mesh;
  from = {0.0, profile.start};
  double wave = 0.0, done = 0.0;
  for (const Cut& cut : profile.cuts) {
    const double length = cut_length(from, cut);
    const auto point = [&](const HeightPoint& at) -> BentPoint {
      const ProfilePoint on = along(from, cut, at.y);
      const Height angle = 2.0 * pi * at.x;
      const Height lift = (wave + (cut.wave - wave) * at.y) * cos(profile.waves * angle);
      return {on.radius * sin(angle), on.height + lift, on.radius * cos(angle)};
    };
    const int rows = static_cast<int>(std::ceil(std::max({1.0, length / row, std::abs(arc_angle(cut)) / widest_turn})));
    append(mesh, pinched_grid_mesh(columns, rows, point, [&](const glm::dvec2& st) {
             return glm::dvec2{st.x, 1.0 - (done + length * st.y) / whole};
           }));
    from = cut.to;
    wave = cut.wave;
    done += length;
  }
  return mesh;
}

}  // namespace footprint
