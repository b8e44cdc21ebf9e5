// See ray_tree.hpp.
#include "renderer/visibility/ray_tree.hpp"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <new>
#include <span>

#include "renderer/core/error.hpp"

namespace footprint {
namespace {

constexpr std::size_t most_triangles = std::size_t{1} << 28U;
constexpr unsigned most_in_leaf = 4;
constexpr float smallest = 1e-20F;

struct Box {
  glm::vec3 lower{std::numeric_limits<float>::max()}, upper{std::numeric_limits<float>::lowest()};

  void add(const Box& other) {
    lower = glm::min(lower, other.lower);
    upper = glm::max(upper, other.upper);
  }
};

// What Embree's builder makes, in memory of its own; a leaf has triangles, an inner node two children.
struct BuiltNode {
  std::array<const BuiltNode*, 2> children{};
  Box box;
  std::array<unsigned, most_in_leaf> triangles{};
  unsigned count = 0;
};

BuiltNode* new_node(RTCThreadLocalAllocator allocator) {
  return new (rtcThreadLocalAlloc(allocator, sizeof(BuiltNode), alignof(BuiltNode))) BuiltNode;
}

void* make_inner(RTCThreadLocalAllocator allocator, unsigned /*children*/, void* /*user*/) {
  return new_node(allocator);
}

void set_children(void* node, void** children, unsigned count, void* /*user*/) {
  auto* inner = static_cast<BuiltNode*>(node);
  for (unsigned i = 0; i < count; ++i) inner->children.at(i) = static_cast<const BuiltNode*>(children[i]);
}

void set_bounds(void* node, const RTCBounds** bounds, unsigned count, void* /*user*/) {
  auto* inner = static_cast<BuiltNode*>(node);
  for (unsigned i = 0; i < count; ++i) {
    const RTCBounds& b = *bounds[i];
    inner->box.add({{b.lower_x, b.lower_y, b.lower_z}, {b.upper_x, b.upper_y, b.upper_z}});
  }
}

void* make_leaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives, std::size_t count,
                void* /*user*/) {
  BuiltNode* leaf = new_node(allocator);
  leaf->count = static_cast<unsigned>(count);
  for (std::size_t i = 0; i < count; ++i) {
    const RTCBuildPrimitive& p = primitives[i];
    leaf->triangles.at(i) = p.primID;
    leaf->box.add({{p.lower_x, p.lower_y, p.lower_z}, {p.upper_x, p.upper_y, p.upper_z}});
  }
  return leaf;
}

std::vector<RayTree::Triangle> triangles_of(const Scene& scene) {
  std::vector<RayTree::Triangle> triangles;
  for (const Mesh& mesh : scene.meshes) {
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
      const glm::vec3& a = mesh.vertices[mesh.indices[i]].position;
      triangles.push_back({glm::vec4(a, 0.0F), glm::vec4(mesh.vertices[mesh.indices[i + 1]].position - a, 0.0F),
                           glm::vec4(mesh.vertices[mesh.indices[i + 2]].position - a, 0.0F)});
    }
  }
  return triangles;
}

std::vector<RTCBuildPrimitive> primitives_of(std::span<const RayTree::Triangle> triangles) {
  std::vector<RTCBuildPrimitive> primitives;
  for (const RayTree::Triangle& triangle : triangles) {
    const glm::vec3 a(triangle.corner), b = a + glm::vec3(triangle.edge_u), c = a + glm::vec3(triangle.edge_v);
    const glm::vec3 lower = glm::min(a, glm::min(b, c)), upper = glm::max(a, glm::max(b, c));
    primitives.push_back(
        {lower.x, lower.y, lower.z, 0, upper.x, upper.y, upper.z, static_cast<unsigned>(primitives.size())});
  }
  return primitives;
}

// Writes a node and all below it.
void flatten(const BuiltNode& built, std::span<const RayTree::Triangle> triangles, RayTree& tree) {
  const std::size_t place = tree.nodes.size();
  tree.nodes.push_back({.lower = built.box.lower, .skip = 0, .upper = built.box.upper, .triangles = 0});
  if (built.count > 0) {
    tree.nodes[place].triangles = static_cast<std::uint32_t>(8 * tree.triangles.size() + built.count);
    for (unsigned i = 0; i < built.count; ++i) tree.triangles.push_back(triangles[built.triangles.at(i)]);
  }
  for (const BuiltNode* child : built.children) {
    if (child != nullptr) flatten(*child, triangles, tree);
  }
  tree.nodes[place].skip = static_cast<std::uint32_t>(tree.nodes.size());
}

bool meets(const RayTree::Triangle& triangle, const glm::vec3& origin, const glm::vec3& direction) {
  // Moeller and Trumbore 1997.
  const glm::vec3 edge_u(triangle.edge_u), edge_v(triangle.edge_v);
  const glm::vec3 across = glm::cross(direction, edge_v);
  const float determinant = glm::dot(edge_u, across);
  if (determinant == 0.0F) return false;
  const glm::vec3 from = origin - glm::vec3(triangle.corner);
  const float u = glm::dot(from, across) / determinant;
  const glm::vec3 other = glm::cross(from, edge_u);
  const float v = glm::dot(direction, other) / determinant;
  return u >= 0.0F && v >= 0.0F && u + v <= 1.0F && glm::dot(edge_v, other) / determinant > 0.0F;
}

}  // namespace

bool RayTree::blocked(const glm::vec3& origin, const glm::vec3& direction) const {
  glm::vec3 safe = direction;  // 0 / 0 where the origin lies in the plane of a box
  for (int i = 0; i < 3; ++i) {
    if (std::abs(safe[i]) < smallest) safe[i] = smallest;
  }
  std::size_t place = 0;
  while (place < nodes.size()) {
    const Node& node = nodes[place];
    const glm::vec3 a = (node.lower - origin) / safe, b = (node.upper - origin) / safe;
    const glm::vec3 near = glm::min(a, b), far = glm::max(a, b);
    const float enter = std::max({near.x, near.y, near.z, 0.0F}), leave = std::min({far.x, far.y, far.z});
    if (enter > leave) {
      place = node.skip;
      continue;
    }
    const std::size_t first = node.triangles / 8;
    for (std::size_t i = first; i < first + node.triangles % 8; ++i) {
      if (meets(triangles[i], origin, direction)) return true;
    }
    ++place;
  }
  return false;
}

RayTree ray_tree(const Scene& scene) {
  const std::vector<RayTree::Triangle> triangles = triangles_of(scene);
  std::vector<RTCBuildPrimitive> primitives = primitives_of(triangles);
  const std::unique_ptr<RTCDeviceTy, decltype(&rtcReleaseDevice)> device(rtcNewDevice(nullptr), rtcReleaseDevice);
  const std::unique_ptr<RTCBVHTy, decltype(&rtcReleaseBVH)> memory(device ? rtcNewBVH(device.get()) : nullptr,
                                                                   rtcReleaseBVH);
  RTCBuildArguments arguments = rtcDefaultBuildArguments();
  arguments.maxBranchingFactor = 2;
  arguments.maxLeafSize = most_in_leaf;
  arguments.bvh = memory.get();
  arguments.primitives = primitives.data();
  arguments.primitiveCount = arguments.primitiveArrayCapacity = primitives.size();
  arguments.createNode = make_inner;
  arguments.setNodeChildren = set_children;
  arguments.setNodeBounds = set_bounds;
  arguments.createLeaf = make_leaf;
  const bool fits = memory && triangles.size() <= most_triangles;
  const auto* root = fits ? static_cast<const BuiltNode*>(rtcBuildBVH(&arguments)) : nullptr;
  if (root == nullptr) {
    throw Error(ErrorKind::machine, scene.source, "its triangles do not fit into a tree for shadow rays",
                "set `cast = false` in [shadows] of a scene.toml, or use a coarser model");
  }
  RayTree tree;
  flatten(*root, triangles, tree);
  return tree;
}

}  // namespace footprint
