// Vertices joined by what they are and by their triangles: a forest of sets (Galler and Fischer 1964).
#include "renderer/scene/charts.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <numeric>
#include <unordered_map>

#include "renderer/core/hash.hpp"

namespace footprint {
namespace {

// Which of the two sets of texture coordinates the maps of a material read.
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

class Forest {
 public:
  explicit Forest(std::size_t size) : parents_(size) { std::iota(parents_.begin(), parents_.end(), 0U); }

  std::uint32_t root(std::uint32_t node) {
    while (parents_[node] != node) node = parents_[node] = parents_[parents_[node]];  // every second one is skipped
    return node;
  }

  void join(std::uint32_t a, std::uint32_t b) { parents_[root(a)] = root(b); }

 private:
  std::vector<std::uint32_t> parents_;
};

}  // namespace

Charts charts_of(std::span<const Vertex> vertices, std::span<const std::uint32_t> indices, const Material& material) {
  const std::array<bool, 2> sets = sets_read_by(material);
  Forest forest(vertices.size());
  std::unordered_map<Key, std::uint32_t, KeyHash> seen;
  for (std::uint32_t i = 0; i < vertices.size(); ++i)
    forest.join(i, seen.try_emplace(key_of(vertices[i], sets), i).first->second);
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    forest.join(indices[i], indices[i + 1]);
    forest.join(indices[i], indices[i + 2]);
  }
  Charts charts;
  std::unordered_map<std::uint32_t, std::uint32_t> numbers;  // of roots, in the order of the first vertex
  for (std::uint32_t i = 0; i < vertices.size(); ++i) {
    const auto [number, is_new] = numbers.try_emplace(forest.root(i), charts.count);
    charts.count += is_new ? 1 : 0;
    charts.of_vertex.push_back(number->second);
  }
  return charts;
}

}  // namespace footprint
