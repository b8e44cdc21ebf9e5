// scales: hemispheres in staggered rows on a flat ground. A hemisphere seen from above has every normal, its x and y
// evenly over the unit disc; the ground between them is a spike at the pole.
#include <cmath>

#include "scenes/surfaces/dome_lattice.hpp"
#include "scenes/surfaces/meshes.hpp"
#include "scenes/surfaces/texel_grid.hpp"

namespace footprint::surfaces::scales {
namespace {

Image normals(const SurfaceSettings& settings) {
  const Options& parameters = settings.parameters;
  const DomeLattice lattice(static_cast<int>(parameters.number("count")), parameters.number("fill"),
                            parameters.number("variation"), settings.seed);
  const double edge = std::sin(glm::radians(parameters.number("edge_degrees")));
  return fill_normals(settings.resolution, [&](const glm::dvec2& uv) {
    const auto dome = lattice.at(uv);
    return dome ? dome->normal(edge) : glm::dvec3{0.0, 0.0, 1.0};
  });
}

}  // namespace

Surface surface() {
  return {
      .name = "scales",
      .summary = "hemispheres in staggered rows on a flat ground",
      .parameters = {whole_option("count", 8, 1, 1024, "scales along the map's width"),
                     number_option("fill", 0.95, 0.1, 1,
                                   "radius of the largest scale as a share of that of touching ones"),
                     number_option("variation", 0.2, 0, 0.9,
                                   "how much smaller than the largest the smallest scale is, as a share of it"),
                     number_option("edge_degrees", 90.0, 0, 90, "tilt at a scale's edge, degrees; 90: hemispheres")},
      .normals = normals,
      .mesh = square_mesh};
}

}  // namespace footprint::surfaces::scales
