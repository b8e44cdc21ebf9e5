// Distances to the nearest edge of the visible region on an octahedral grid; samples by a grid over positions.
#include "renderer/visibility/signed_distance.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "renderer/environment/radiance_stack.hpp"

namespace footprint {
namespace {

glm::dvec2 middle_of_cell(int x, int y) { return (glm::dvec2(x, y) + 0.5) / static_cast<double>(visibility_edge); }

std::vector<glm::vec3> grid_directions() {
  std::vector<glm::vec3> directions;
  for (int y = 0; y < visibility_edge; ++y) {
    for (int x = 0; x < visibility_edge; ++x) directions.emplace_back(octahedral_direction(middle_of_cell(x, y)));
  }
  return directions;
}

// All pairs of cells that share per side. Each side of the square is folded onto itself.
std::vector<std::pair<std::size_t, std::size_t>> grid_neighbours() {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  const auto cell = [](int x, int y) { return visibility_cell(octahedral_direction(middle_of_cell(x, y))); };
  for (int i = 0; i < visibility_edge; ++i) {
    for (int j = -1; j < visibility_edge; ++j) {
      pairs.emplace_back(cell(j, i), cell(j + 1, i));
      pairs.emplace_back(cell(i, j), cell(i, j + 1));
    }
  }
  return pairs;
}

// Points halfway between a visible and a hidden neighbour.
std::vector<glm::vec3> edges_of(const SphereVisibility& visible) {
  static const std::vector<std::pair<std::size_t, std::size_t>> neighbours = grid_neighbours();
  const std::vector<glm::vec3>& directions = visibility_directions();
  std::vector<glm::vec3> edges;
  for (const auto& [a, b] : neighbours) {
    if (visible[a] != visible[b]) edges.push_back(glm::normalize(directions[a] + directions[b]));
  }
  return edges;
}

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

std::size_t visibility_cell(const glm::dvec3& direction) {
  const glm::dvec2 cell = octahedral_uv(direction) * static_cast<double>(visibility_edge);
  const int x = std::clamp(static_cast<int>(cell.x), 0, visibility_edge - 1);
  const int y = std::clamp(static_cast<int>(cell.y), 0, visibility_edge - 1);
  return static_cast<std::size_t>(y) * visibility_edge + static_cast<std::size_t>(x);
}

const std::vector<glm::vec3>& visibility_directions() {
  static const std::vector<glm::vec3> directions = grid_directions();
  return directions;
}

SphereVisibility visibility_at(const Occluders& occluders, const glm::vec3& point, const glm::vec3& normal,
                               Horizon horizon) {
  const std::vector<glm::vec3>& directions = visibility_directions();
  const glm::vec3 start = point + occluders.offset() * normal;
  std::vector<glm::vec3> above;
  std::vector<std::size_t> cells;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    if (glm::dot(directions[i], normal) <= 0.0F) continue;
    above.push_back(directions[i]);
    cells.push_back(i);
  }
  const std::vector<bool> blocked = occluders.blocked(start, above);
  SphereVisibility visible;
  if (horizon == Horizon::open) visible.set();
  for (std::size_t i = 0; i < cells.size(); ++i) visible[cells[i]] = !blocked[i];
  return visible;
}

std::vector<float> signed_distances(const SphereVisibility& visible, std::span<const glm::vec3> directions) {
  const std::vector<glm::vec3> edges = edges_of(visible);
  constexpr float farthest = std::numbers::pi_v<float>;
  if (edges.empty()) return std::vector<float>(directions.size(), visible.any() ? farthest : -farthest);
  using Columns = Eigen::Map<const Eigen::Matrix3Xf>;
  static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
  const Columns edge_columns(&edges.front().x, 3, static_cast<Eigen::Index>(edges.size()));
  std::vector<float> distances;
  distances.reserve(directions.size());
  for (const glm::vec3& direction : directions) {
    const Eigen::Vector3f d(direction.x, direction.y, direction.z);
    const float angle = std::acos(std::clamp((d.transpose() * edge_columns).maxCoeff(), -1.0F, 1.0F));
    distances.push_back(visible[visibility_cell(direction)] ? angle : -angle);
  }
  return distances;
}

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
  constexpr float same = 1e-3F;  // rounding of the normals' product
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
