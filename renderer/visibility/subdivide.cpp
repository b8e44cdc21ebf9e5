// Edges are halved until none is too long, each once for the triangles on both its sides.
#include "renderer/visibility/subdivide.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>
#include <utility>

namespace footprint {
namespace {

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
  Splitter(std::vector<Vertex>& vertices, float longest) : vertices_(vertices), longest_(longest) {}

  // Appends the parts of a triangle; gives whether there is more than one.
  bool split(const Triangle& t, std::vector<std::uint32_t>& parts) {
    const std::array<bool, 3> cut{is_long(t[0], t[1]), is_long(t[1], t[2]), is_long(t[2], t[0])};
    const auto cuts = std::ranges::count(cut, true);
    // Turned so that the first edge is cut and, of two, the second too; of one, only the first.
    std::size_t turn = 0;
    while (cuts > 0 && cuts < 3 && !(cut.at(turn) && (cuts == 1 || cut.at((turn + 1) % 3)))) ++turn;
    const std::uint32_t a = t.at(turn), b = t.at((turn + 1) % 3), c = t.at((turn + 2) % 3);
    if (cuts == 0) {
      append(parts, {{{a, b, c}}});
      return false;
    }
    const std::uint32_t ab = between(a, b);
    if (cuts == 1) {
      append(parts, {{{a, ab, c}, {ab, b, c}}});
      return true;
    }
    const std::uint32_t bc = between(b, c);
    if (cuts == 2) {
      append(parts, {{{ab, b, bc}, {a, ab, c}, {ab, bc, c}}});
      return true;
    }
    const std::uint32_t ca = between(c, a);
    append(parts, {{{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}});
    return true;
  }

 private:
  static void append(std::vector<std::uint32_t>& parts, const std::vector<Triangle>& triangles) {
    for (const Triangle& triangle : triangles) parts.insert(parts.end(), triangle.begin(), triangle.end());
  }

  [[nodiscard]] bool is_long(std::uint32_t a, std::uint32_t b) const {
    return glm::distance(vertices_[a].position, vertices_[b].position) > longest_;
  }

  std::uint32_t between(std::uint32_t a, std::uint32_t b) {
    const auto [entry, is_new] = middles_.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(vertices_.size()));
    if (is_new) vertices_.push_back(middle(vertices_[a], vertices_[b]));
    return entry->second;
  }

  std::vector<Vertex>& vertices_;
  float longest_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles_;
};

}  // namespace

Mesh subdivided(const Mesh& mesh, float longest) {
  if (!(longest > 0.0F)) throw std::logic_error("edges cannot be made to have no length");
  Mesh out = mesh;
  bool any = true;
  while (any) {
    any = false;
    Splitter splitter(out.vertices, longest);
    std::vector<std::uint32_t> parts;
    for (std::size_t i = 0; i + 2 < out.indices.size(); i += 3) {
      any = splitter.split({out.indices[i], out.indices[i + 1], out.indices[i + 2]}, parts) || any;
    }
    out.indices = std::move(parts);
  }
  return out;
}

}  // namespace footprint
