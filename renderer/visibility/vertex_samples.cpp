// Samples in a hash grid: a vertex that is near none becomes one.
#include "renderer/visibility/vertex_samples.hpp"

#include <algorithm>
#include <cmath>

namespace footprint {
namespace {

constexpr float reach = 2.0F;
constexpr float cosine_at_one = 0.9396926F;  // 20 degrees between two normals are a distance of 1

glm::vec3 unit(const glm::vec3& v) { return v / std::max(glm::length(v), 1e-20F); }

// Cells that share a number only cost time: distances decide.
std::uint64_t number_of(const glm::ivec3& cell) {
  constexpr std::uint64_t mask = (1U << 21U) - 1U;
  const auto part = [](int value) { return static_cast<std::uint64_t>(static_cast<std::uint32_t>(value)) & mask; };
  return part(cell.x) | part(cell.y) << 21U | part(cell.z) << 42U;
}

}  // namespace

VertexSamples::VertexSamples(const std::vector<const Vertex*>& vertices, float spacing) : spacing_(spacing) {
  if (!vertices.empty()) origin_ = vertices.front()->position;
  for (const Vertex* vertex : vertices) {
    if (std::ranges::any_of(near(*vertex), [](const Near& found) { return found.distance <= 1.0F; })) continue;
    grid_[number_of(cell_of(vertex->position))].push_back(static_cast<std::uint32_t>(samples_.size()));
    samples_.push_back(vertex);
  }
}

glm::ivec3 VertexSamples::cell_of(const glm::vec3& position) const {
  return glm::ivec3(glm::floor((position - origin_) / (reach * spacing_)));
}

std::vector<VertexSamples::Near> VertexSamples::near(const Vertex& vertex) const {
  std::vector<Near> found;
  const glm::vec3 normal = unit(vertex.normal);
  const glm::ivec3 middle = cell_of(vertex.position);
  for (int i = 0; i < 27; ++i) {
    const auto cell = grid_.find(number_of(middle + glm::ivec3(i % 3, i / 3 % 3, i / 9) - 1));
    if (cell == grid_.end()) continue;
    for (const std::uint32_t sample : cell->second) {
      const glm::vec3 apart = (samples_[sample]->position - vertex.position) / spacing_;
      const float turned = 1.0F - glm::dot(unit(samples_[sample]->normal), normal);
      const float distance = std::sqrt(glm::dot(apart, apart) + std::max(turned, 0.0F) / (1.0F - cosine_at_one));
      if (distance < reach) found.push_back({sample, distance});
    }
  }
  return found;
}

void VertexSamples::interpolate(const Vertex& vertex,
                                const std::function<void(std::size_t sample, float weight)>& add) const {
  constexpr float same = 1e-3F;  // rounding of the normals' product alone
  std::vector<Near> found = near(vertex);
  if (const auto own = std::ranges::min_element(found, {}, &Near::distance);
      own != found.end() && own->distance < same) {
    add(own->sample, 1.0F);
    return;
  }
  float sum = 0;
  for (Near& one : found) {
    one.distance = std::pow((reach - one.distance) / one.distance, 2.0F);
    sum += one.distance;
  }
  for (const Near& one : found) add(one.sample, one.distance / sum);
}

}  // namespace footprint
