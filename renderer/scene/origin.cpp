// Compares distances from zero with sizes.
#include "renderer/scene/origin.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace footprint {
namespace {

constexpr double most_radii = 16.0;         // from zero, in 32 bits
constexpr double most_radii_wide = 0x1p32;  // in 64 bits

double radius_of(const WideBounds& bounds) { return 0.5 * glm::length(bounds.upper - bounds.lower); }

// The largest coordinate of the bounds, which rounds most.
double largest_coordinate(const WideBounds& bounds) {
  const glm::dvec3 far = glm::max(glm::abs(bounds.lower), glm::abs(bounds.upper));
  return std::max({far.x, far.y, far.z});
}

}  // namespace

glm::dvec3 origin_for(const WideBounds& bounds, const glm::dvec3& otherwise) {
  if (bounds.empty()) return glm::dvec3{0.0};
  const glm::dvec3 centre = 0.5 * (bounds.lower + bounds.upper);
  for (const glm::dvec3& origin : {glm::dvec3{0.0}, otherwise}) {
    if (glm::distance(centre, origin) <= most_radii * radius_of(bounds)) return origin;
  }
  return centre;
}

std::string rounding_warning(const WideBounds& bounds) {
  if (bounds.empty() || !(largest_coordinate(bounds) > most_radii_wide * radius_of(bounds)) || radius_of(bounds) == 0.0)
    return {};
  return fmt::format(
      "the scene is up to {:.3g} m from the origin and {:.3g} m in radius: 64 bits round its positions visibly",
      largest_coordinate(bounds), radius_of(bounds));
}

}  // namespace footprint
