// Projects normals by either map of directions to a plane; mean and covariance from sums, the log density from both.
#include "methods/cells/plane.hpp"

#include <algorithm>
#include <cmath>

#include "renderer/bake/slope_moments.hpp"

namespace footprint::cells {
namespace {

constexpr double least_share = 1e-6;  // a part that is empty here may gain texels later

}  // namespace

std::vector<PlanePoint> plane_points(const Image& normals, Coordinates coordinates, double steepest) {
  std::vector<PlanePoint> points(normals.texel_count());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const float* const n = &normals.texels[4 * i];
    const glm::dvec3 normal(n[0], n[1], n[2]);
    if (n[3] <= 0.0F || glm::length(normal) < 1e-3) continue;
    const glm::dvec3 unit = glm::normalize(normal);
    points[i] = {.at = coordinates == Coordinates::slopes ? slope_of(unit, steepest) : stereographic_of(unit),
                 .weight = n[3]};
  }
  return points;
}

void PlaneSums::add(const glm::dvec2& p, double w) {
  weight += w;
  first += w * p;
  second += w * glm::dvec3(p.x * p.x, p.x * p.y, p.y * p.y);
}

void PlaneSums::add(const PlaneSums& others) {
  weight += others.weight;
  first += others.first;
  second += others.second;
}

void Quadratic::add(const Quadratic& other, double factor) {
  c += factor * other.c;
  b += factor * other.b;
  a += factor * other.a;
}

double Quadratic::at(const glm::dvec2& p) const {
  return c + glm::dot(b, p) - 0.5 * (a.x * p.x * p.x + a.z * p.y * p.y) - a.y * p.x * p.y;
}

Quadratic log_density(const PlaneSums& sums, double share, double variance) {
  const double weight = std::max(sums.weight, 1e-12);
  const glm::dvec2 mean = sums.first / weight;
  const double scale = 0.5 * (1.0 + glm::dot(mean, mean));
  const double floor = std::max(lobe_floor * variance * scale * scale, 1e-9);
  const double xx = std::max(sums.second.x / weight - mean.x * mean.x, 0.0) + floor;
  const double yy = std::max(sums.second.z / weight - mean.y * mean.y, 0.0) + floor;
  const double most = std::sqrt((xx - floor) * (yy - floor));
  const double xy = std::clamp(sums.second.y / weight - mean.x * mean.y, -most, most);
  const double determinant = xx * yy - xy * xy;
  const glm::dvec3 inverse = glm::dvec3(yy, -xy, xx) / determinant;
  const glm::dvec2 b(inverse.x * mean.x + inverse.y * mean.y, inverse.y * mean.x + inverse.z * mean.y);
  return {.c = std::log(std::max(share, least_share)) - 0.5 * std::log(determinant) - 0.5 * glm::dot(b, mean),
          .b = b,
          .a = inverse};
}

}  // namespace footprint::cells
