// A triangle for each sample by its share of the area, and a random point of it.
#include "renderer/microgeometry/facet_samples.hpp"

#include <cmath>
#include <random>

#include "renderer/core/random.hpp"

namespace footprint {
namespace {

// Uniform over a triangle: the fold of the unit square (Turk 1990, "Generating Random Points in Triangles").
glm::vec3 point_in(const Patch& patch, const glm::uvec3& triangle, double u, double v) {
  if (u + v > 1.0) {
    u = 1.0 - u;
    v = 1.0 - v;
  }
  const glm::dvec3 a(patch.vertices[triangle.x]);
  const glm::dvec3 b(patch.vertices[triangle.y]);
  const glm::dvec3 c(patch.vertices[triangle.z]);
  return glm::vec3(a + u * (b - a) + v * (c - a));
}

}  // namespace

FacetSamples sample_facets(const Patch& patch, std::size_t count, std::uint64_t seed) {
  std::vector<double> areas(patch.triangles.size());
  double total = 0.0;
  for (std::size_t i = 0; i < areas.size(); ++i) total += areas[i] = facet_plane(patch, i).area;

  FacetSamples samples;
  samples.positions.reserve(count);
  samples.triangles.reserve(count);
  samples.facet_area = total / static_cast<double>(count);
  std::mt19937_64 random(seed);
  std::size_t triangle = 0;
  double before = 0.0;  // area of the triangles before this one
  for (std::size_t i = 0; i < count; ++i) {
    const double position = (static_cast<double>(i) + uniform(random)) * samples.facet_area;
    while (triangle + 1 < areas.size() && (position >= before + areas[triangle] || areas[triangle] == 0.0)) {
      before += areas[triangle++];
    }
    while (areas[triangle] == 0.0) --triangle;  // rounding can leave the last position behind the last area
    const double u = uniform(random);
    samples.positions.push_back(point_in(patch, patch.triangles[triangle], u, uniform(random)));
    samples.triangles.push_back(static_cast<std::uint32_t>(triangle));
  }
  return samples;
}

}  // namespace footprint
