// studs: hemispherical studs of metal, from satin to polished, on a matt glazed ground: normals and BRDF change
// together.
#include <cmath>

#include "scenes/surfaces/dome_lattice.hpp"
#include "scenes/surfaces/meshes.hpp"
#include "scenes/surfaces/texel_grid.hpp"

namespace footprint::surfaces::studs {
namespace {

/// What a point is made of.
struct Stuff {
  glm::dvec3 albedo, specular;
  double exponent;
};

constexpr Stuff ground{{0.02, 0.12, 0.20}, {0.04, 0.04, 0.04}, 12.0};
constexpr Stuff gold{{0.16, 0.09, 0.02}, {0.72, 0.48, 0.16}, 0.0}, steel{{0.05, 0.05, 0.055}, {0.42, 0.43, 0.46}, 0.0};

/// Exponents of the dullest and the most polished stud.
constexpr double dullest = 24.0, glossiest = 600.0;

DomeLattice studs(const SurfaceSettings& settings) {
  const Options& parameters = settings.parameters;
  return {static_cast<int>(parameters.number("count")), parameters.number("fill"), 0.15, settings.seed};
}

Stuff stuff_at(const DomeLattice& lattice, const glm::dvec2& uv) {
  const auto dome = lattice.at(uv);
  if (!dome) return ground;
  Stuff stuff = dome->chance < 0.5 ? gold : steel;
  const double polish = 2.0 * dome->chance - std::floor(2.0 * dome->chance);
  stuff.exponent = dullest * std::pow(glossiest / dullest, polish);
  return stuff;
}

Image normals(const SurfaceSettings& settings) {
  const DomeLattice lattice = studs(settings);
  const double edge = std::sin(glm::radians(settings.parameters.number("edge_degrees")));
  return fill_normals(settings.resolution, [&](const glm::dvec2& uv) {
    const auto dome = lattice.at(uv);
    return dome ? dome->normal(edge) : glm::dvec3{0.0, 0.0, 1.0};
  });
}

Image base_color(const SurfaceSettings& settings) {
  const DomeLattice lattice = studs(settings);
  return fill_colors(glm::ivec2{settings.resolution},
                     [&](const glm::dvec2& uv) { return stuff_at(lattice, uv).albedo; });
}

Image specular(const SurfaceSettings& settings) {
  const DomeLattice lattice = studs(settings);
  return fill_rgb(glm::ivec2{settings.resolution},
                  [&](const glm::dvec2& uv) { return stuff_at(lattice, uv).specular; });
}

Image exponents(const SurfaceSettings& settings) {
  const DomeLattice lattice = studs(settings);
  return fill_values(glm::ivec2{settings.resolution},
                     [&](const glm::dvec2& uv) { return stuff_at(lattice, uv).exponent; });
}

}  // namespace

Surface surface() {
  return {.name = "studs",
          .summary = "hemispherical metal studs, satin to polished, on a matt ground",
          .parameters = {whole_option("count", 48, 1, 1024, "studs along the map's width"),
                         number_option("fill", 0.85, 0.1, 1,
                                       "radius of the largest stud as a share of that of touching ones"),
                         number_option("edge_degrees", 90.0, 0, 90, "tilt at a stud's edge, degrees; 90: hemispheres")},
          .default_resolution = 1024,
          .normals = normals,
          .base_color = base_color,
          .specular = specular,
          .lobe_parameter = exponents,
          .distribution = NormalDistribution::blinn_phong,
          .mesh = square_mesh};
}

}  // namespace footprint::surfaces::studs
