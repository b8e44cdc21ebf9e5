// Triangle lists, normals, and new vertices with the means of their edge's ends.
#include "renderer/scene/geometry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

namespace footprint {
namespace {

constexpr std::uint32_t unused = std::numeric_limits<std::uint32_t>::max();

/// Twice the area times the normal.
glm::dvec3 area_normal(const Vertex& a, const Vertex& b, const Vertex& c) {
  const glm::dvec3 origin{a.position};
  return glm::cross(glm::dvec3{b.position} - origin, glm::dvec3{c.position} - origin);
}

using Triangle = std::array<std::uint32_t, 3>;

Vertex middle(const Vertex& a, const Vertex& b) {
  return {.position = 0.5F * (a.position + b.position),
          .normal = 0.5F * (a.normal + b.normal),
          .tangent = 0.5F * (a.tangent + b.tangent),
          .uv0 = 0.5F * (a.uv0 + b.uv0),
          .uv1 = 0.5F * (a.uv1 + b.uv1),
          .color = 0.5F * (a.color + b.color)};
}

class Splitter {
 public:
  // measured: the places between which edges have their lengths, one per vertex.
  Splitter(std::vector<Vertex>& vertices, std::vector<glm::vec3>& measured, float longest)
      : vertices_(vertices), measured_(measured), longest_(longest) {}

  // Appends the parts of a triangle; gives whether there is more than one.
  bool split(const Triangle& t, std::vector<std::uint32_t>& parts) {
    const std::array<bool, 3> cut{is_long(t[0], t[1]), is_long(t[1], t[2]), is_long(t[2], t[0])};
    const auto cuts = std::ranges::count(cut, true);
    // Turned so that the first edge is cut and, of two, the second too; of one, only the first.
    std::size_t turn = 0;
    while (cuts > 0 && cuts < 3 && !(cut.at(turn) && (cuts == 1 || cut.at((turn + 1) % 3)))) ++turn;
    const std::uint32_t a = t.at(turn), b = t.at((turn + 1) % 3), c = t.at((turn + 2) % 3);
    const std::uint32_t ab = cuts > 0 ? between(a, b) : unused, bc = cuts > 1 ? between(b, c) : unused;
    if (cuts == 0) append(parts, {{{a, b, c}}});
    if (cuts == 1) append(parts, {{{a, ab, c}, {ab, b, c}}});
    if (cuts == 2) append(parts, {{{ab, b, bc}, {a, ab, c}, {ab, bc, c}}});
    if (cuts == 3) {
      const std::uint32_t ca = between(c, a);
      append(parts, {{{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}});
    }
    return cuts > 0;
  }

 private:
  static void append(std::vector<std::uint32_t>& parts, const std::vector<Triangle>& triangles) {
    for (const Triangle& triangle : triangles) parts.insert(parts.end(), triangle.begin(), triangle.end());
  }

  [[nodiscard]] bool is_long(std::uint32_t a, std::uint32_t b) const {
    return glm::distance(measured_[a], measured_[b]) > longest_;
  }

  std::uint32_t between(std::uint32_t a, std::uint32_t b) {
    const auto [entry, is_new] = middles_.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(vertices_.size()));
    if (is_new) {
      vertices_.push_back(middle(vertices_[a], vertices_[b]));
      measured_.push_back(0.5F * (measured_[a] + measured_[b]));
    }
    return entry->second;
  }

  std::vector<Vertex>& vertices_;
  std::vector<glm::vec3>& measured_;
  float longest_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles_;
};

}  // namespace

glm::dvec3 unit_or(const glm::dvec3& vector, const glm::dvec3& fallback) {
  const double largest = std::max({std::abs(vector.x), std::abs(vector.y), std::abs(vector.z)});
  if (!(largest > 0.0) || !std::isfinite(largest)) return fallback;
  return glm::normalize(vector / largest);  // squares of tiny lengths would underflow
}

std::vector<std::uint32_t> triangle_list(std::span<const std::uint32_t> indices, Topology topology) {
  std::vector<std::uint32_t> list;
  if (indices.size() < 3) return list;
  if (topology == Topology::triangles) {
    const auto whole = static_cast<std::ptrdiff_t>(indices.size() / 3 * 3);
    list.assign(indices.begin(), indices.begin() + whole);
    return list;
  }
  list.reserve((indices.size() - 2) * 3);
  for (std::size_t i = 0; i + 2 < indices.size(); ++i) {
    if (topology == Topology::strip) {
      const std::size_t odd = i % 2;
      list.insert(list.end(), {indices[i], indices[i + 1 + odd], indices[i + 2 - odd]});
    } else {
      list.insert(list.end(), {indices[i + 1], indices[i + 2], indices[0]});
    }
  }
  return list;
}

TriangleSoup collect_triangles(const Scene& scene, std::size_t material) {
  TriangleSoup all;
  for (const Mesh& mesh : scene.meshes) {
    if (static_cast<std::size_t>(mesh.material) != material) continue;
    const auto base = static_cast<std::uint32_t>(all.vertices.size());
    all.vertices.insert(all.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    for (const std::uint32_t index : mesh.indices) all.indices.push_back(base + index);
  }
  return all;
}

void drop_unused_vertices(std::vector<Vertex>& vertices, std::vector<std::uint32_t>& indices) {
  std::vector<std::uint32_t> new_index(vertices.size(), unused);
  std::vector<Vertex> used;
  for (std::uint32_t& index : indices) {
    if (new_index[index] == unused) {
      new_index[index] = static_cast<std::uint32_t>(used.size());
      used.push_back(vertices[index]);
    }
    index = new_index[index];
  }
  vertices = std::move(used);
}

void append(Mesh& mesh, const Mesh& part) {
  const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), part.vertices.begin(), part.vertices.end());
  for (const std::uint32_t index : part.indices) mesh.indices.push_back(base + index);
}

void make_flat_normals(std::vector<Vertex>& vertices, std::vector<std::uint32_t>& indices) {
  std::vector<Vertex> corners;
  corners.reserve(indices.size());
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    const Vertex &a = vertices[indices[i]], &b = vertices[indices[i + 1]], &c = vertices[indices[i + 2]];
    const glm::vec3 normal{unit_or(area_normal(a, b, c), {0.0, 0.0, 1.0})};
    for (const Vertex* corner : {&a, &b, &c}) corners.emplace_back(*corner).normal = normal;
  }
  vertices = std::move(corners);
  indices.resize(vertices.size());
  for (std::uint32_t i = 0; i < indices.size(); ++i) indices[i] = i;
}

std::size_t repair_normals(std::span<Vertex> vertices, std::span<const std::uint32_t> indices,
                           std::span<const std::uint32_t> positions) {
  std::vector<bool> broken(vertices.size(), false);
  std::size_t count = 0;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const glm::dvec3 normal = unit_or(glm::dvec3{vertices[i].normal}, glm::dvec3{0.0});
    broken[i] = !(glm::dot(normal, normal) > 0.5);  // also true for NaN
    count += broken[i] ? 1 : 0;
    vertices[i].normal = glm::vec3{normal};
  }
  if (count == 0) return 0;
  const auto place_of = [&](std::size_t vertex) { return positions.empty() ? vertex : positions[vertex]; };
  const std::size_t places = positions.empty() ? vertices.size() : std::ranges::max(positions) + std::size_t{1};
  std::vector<glm::dvec3> sums(places, glm::dvec3{0.0});
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    const glm::dvec3 normal = area_normal(vertices[indices[i]], vertices[indices[i + 1]], vertices[indices[i + 2]]);
    for (std::size_t corner = 0; corner < 3; ++corner) {
      if (const std::uint32_t vertex = indices[i + corner]; broken[vertex]) sums[place_of(vertex)] += normal;
    }
  }
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (broken[i]) vertices[i].normal = glm::vec3{unit_or(sums[place_of(i)], {0.0, 0.0, 1.0})};
  }
  return count;
}

Mesh make_plane(glm::vec2 size, glm::vec2 uv_tiling) {
  constexpr std::array<glm::vec2, 4> corners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};  // uv, v downwards
  Mesh mesh;
  mesh.name = "plane";
  for (const glm::vec2& corner : corners) {
    Vertex vertex;
    vertex.position = {(corner.x - 0.5F) * size.x, (0.5F - corner.y) * size.y, 0.0F};
    vertex.uv0 = corner * uv_tiling;
    vertex.uv1 = vertex.uv0;
    // v runs against y, so the bitangent (the direction in which v's green channel counts as up) is +y: w = +1.
    vertex.tangent = {1.0F, 0.0F, 0.0F, 1.0F};
    mesh.vertices.push_back(vertex);
  }
  mesh.indices = {0, 3, 2, 0, 2, 1};
  return mesh;
}

Mesh subdivided(const Mesh& mesh, float longest, const Mesh* shape) {
  if (!(longest > 0.0F)) throw std::logic_error("edges cannot be made to have no length");
  Mesh out = mesh;
  std::vector<glm::vec3> measured;
  for (const Vertex& vertex : (shape != nullptr ? *shape : mesh).vertices) measured.push_back(vertex.position);
  bool any = true;
  while (any) {
    any = false;
    Splitter splitter(out.vertices, measured, longest);
    std::vector<std::uint32_t> parts;
    for (std::size_t i = 0; i + 2 < out.indices.size(); i += 3) {
      any = splitter.split({out.indices[i], out.indices[i + 1], out.indices[i + 2]}, parts) || any;
    }
    out.indices = std::move(parts);
  }
  return out;
}

}  // namespace footprint
