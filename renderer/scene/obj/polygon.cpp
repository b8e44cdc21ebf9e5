// Flattens a polygon along the largest axis of its normal, and cuts off corners whose triangle contains no other
// corner.
#include "renderer/scene/obj/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

#include "renderer/core/process.hpp"

namespace footprint {
namespace {

using Corners = std::vector<glm::dvec2>;

// Twice the area vector (Newell).
glm::dvec3 area_vector(std::span<const glm::dvec3> corners) {
  glm::dvec3 sum(0.0);
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    sum += glm::cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
  return sum;
}

// The corners seen against the normal, so that they run counter-clockwise.
Corners flattened(std::span<const glm::dvec3> corners) {
  const glm::dvec3 normal = area_vector(corners), size = glm::abs(normal);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  Corners flat;
  for (const glm::dvec3& corner : corners) {
    const double u = corner[(axis + 1) % 3] - corners[0][(axis + 1) % 3];
    const double v = corner[(axis + 2) % 3] - corners[0][(axis + 2) % 3];
    flat.emplace_back(normal[axis] < 0.0 ? glm::dvec2(v, u) : glm::dvec2(u, v));
  }
  return flat;
}

// Twice the signed area of a triangle.
double area(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool is_fan(const Corners& flat) {
  double whole = 0.0, least = 0.0;
  for (std::size_t i = 1; i + 1 < flat.size(); ++i) {
    const double part = area(flat[0], flat[i], flat[i + 1]);
    whole += part;
    least = std::min(least, part);
  }
  return least >= -1e-6 * std::abs(whole);  // rounded positions of corners on a line
}

void append_fan(std::span<const std::uint32_t> ring, std::vector<std::uint32_t>& triangles) {
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) triangles.insert(triangles.end(), {ring[0], ring[i], ring[i + 1]});
}

class EarCutter {
 public:
  explicit EarCutter(const Corners& corners) : corners_(corners) {
    for (std::uint32_t i = 0; i < corners.size(); ++i) ring_.push_back(i);
  }

  std::vector<std::uint32_t> cut() {
    std::vector<std::uint32_t> triangles;
    std::size_t at = 0, failed = 0;
    while (ring_.size() > 3 && failed < ring_.size()) {
      if (at % 64 == 0) throw_if_interrupted();
      if (!is_ear(at)) {
        at = (at + 1) % ring_.size();
        ++failed;
        continue;
      }
      triangles.insert(triangles.end(), {before(at), ring_[at], after(at)});
      ring_.erase(ring_.begin() + static_cast<std::ptrdiff_t>(at));
      at %= ring_.size();
      failed = 0;
    }
    append_fan(ring_, triangles);
    return triangles;
  }

 private:
  [[nodiscard]] std::uint32_t before(std::size_t at) const { return ring_[(at + ring_.size() - 1) % ring_.size()]; }
  [[nodiscard]] std::uint32_t after(std::size_t at) const { return ring_[(at + 1) % ring_.size()]; }

  [[nodiscard]] bool is_ear(std::size_t at) const {
    const glm::dvec2 &a = corners_[before(at)], &b = corners_[ring_[at]], &c = corners_[after(at)];
    if (!(area(a, b, c) > 0.0)) return false;
    return std::ranges::none_of(ring_, [&](std::uint32_t index) {
      const glm::dvec2& p = corners_[index];
      if (p == a || p == b || p == c) return false;
      return area(a, b, p) >= 0.0 && area(b, c, p) >= 0.0 && area(c, a, p) >= 0.0;
    });
  }

  const Corners& corners_;
  std::vector<std::uint32_t> ring_;  // of corners that are not cut off
};

}  // namespace

bool is_fan(std::span<const glm::dvec3> corners) { return is_fan(flattened(corners)); }

std::vector<std::uint32_t> triangulated(std::span<const glm::dvec3> corners) {
  if (corners.size() < 3) throw std::logic_error("a polygon has at least 3 corners");
  const Corners flat = flattened(corners);
  if (!is_fan(flat)) {
    if (corners.size() > most_concave_corners) throw std::logic_error("a concave polygon of too many corners");
    return EarCutter(flat).cut();
  }
  std::vector<std::uint32_t> ring(corners.size()), triangles;
  for (std::uint32_t i = 0; i < ring.size(); ++i) ring[i] = i;
  append_fan(ring, triangles);
  return triangles;
}

}  // namespace footprint
