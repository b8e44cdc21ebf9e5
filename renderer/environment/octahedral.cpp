// The fold of the lower half over the upper, and the border that bilinear filtering needs.
#include "renderer/environment/octahedral.hpp"

#include <cmath>

namespace footprint {
namespace {

double sign_of(double x) { return x >= 0.0 ? 1.0 : -1.0; }

glm::dvec2 folded(const glm::dvec2& p) {
  return {(1.0 - std::abs(p.y)) * sign_of(p.x), (1.0 - std::abs(p.x)) * sign_of(p.y)};
}

}  // namespace

glm::dvec2 octahedral_uv(const glm::dvec3& direction) {
  const glm::dvec3 p = direction / (std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z));
  const glm::dvec2 flat(p.x, p.z);
  return 0.5 + 0.5 * (p.y >= 0.0 ? flat : folded(flat));
}

glm::dvec3 octahedral_direction(const glm::dvec2& uv) {
  glm::dvec2 p = 2.0 * uv - 1.0;
  // Across an edge the square goes on as itself, turned by half a turn about the edge's middle.
  if (std::abs(p.x) > 1.0) p = {2.0 * sign_of(p.x) - p.x, -p.y};
  if (std::abs(p.y) > 1.0) p = {-p.x, 2.0 * sign_of(p.y) - p.y};
  const double y = 1.0 - std::abs(p.x) - std::abs(p.y);
  if (y < 0.0) p = folded(p);
  return glm::normalize(glm::dvec3(p.x, y, p.y));
}

glm::dvec3 bordered_texel_direction(int size, int x, int y) {
  return octahedral_direction(glm::dvec2(x - 0.5, y - 0.5) / static_cast<double>(size - 2));
}

double octahedral_stretch(const glm::dvec3& direction) {
  // A face of the octahedron is flat and its normal has (|x| + |y| + |z|) / sqrt(3) to the direction; the square
  // shrinks it by sqrt(3) and has sides of 2.
  const double sum = std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z);
  return 4.0 * sum * sum * sum;
}

}  // namespace footprint
