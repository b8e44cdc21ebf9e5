// Where the positions of a scene are measured from, so that 32 bits represent them well.
#pragma once

#include <glm/glm.hpp>
#include <limits>
#include <string>

#include "renderer/scene/scene.hpp"

namespace footprint {

/// Bounds in the user's coordinates, which may be far from zero.
struct WideBounds {
  glm::dvec3 lower{std::numeric_limits<double>::infinity()}, upper{-std::numeric_limits<double>::infinity()};

  void add(const glm::dvec3& point) {
    lower = glm::min(lower, point);
    upper = glm::max(upper, point);
  }
  /// origin: what `bounds` are measured from.
  void add(const Bounds& bounds, const glm::dvec3& origin) {
    add(glm::dvec3{bounds.lower} + origin);
    add(glm::dvec3{bounds.upper} + origin);
  }
  void add(const WideBounds& other) {
    lower = glm::min(lower, other.lower);
    upper = glm::max(upper, other.upper);
  }
  [[nodiscard]] bool empty() const { return !(lower.x <= upper.x); }
  [[nodiscard]] Bounds from(const glm::dvec3& origin) const {
    return {glm::vec3{lower - origin}, glm::vec3{upper - origin}};
  }
};

/// The origin for positions within bounds: zero, `otherwise`, or the centre, the first that is within 16 radii of the
/// centre. So near, 32 bits round a position by at most 2^-20 of the radius, a thousandth of a texel of 1024.
[[nodiscard]] glm::dvec3 origin_for(const WideBounds& bounds, const glm::dvec3& otherwise = glm::dvec3{0.0});

/// A warning if even 64 bits, in which files and nodes place things, round positions by over 2^-21 of the radius of
/// their bounds; else empty.
[[nodiscard]] std::string rounding_warning(const WideBounds& bounds);

}  // namespace footprint
