// hall_cloth: figured curtains in the arches of a hall, in one of three colours that take turns.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/scene/geometry.hpp"
#include "scenes/surfaces/hall.hpp"
#include "scenes/surfaces/jacquard.hpp"
#include "scenes/surfaces/meshes.hpp"
#include "scenes/surfaces/noise.hpp"
#include "scenes/surfaces/texel_grid.hpp"

namespace footprint::surfaces::hall_cloth {
namespace {

const std::vector<std::string> dyes{"red", "green", "blue"};

/// Metres: the cloth's rail, its lower edge, and its width where it is gathered at the rail.
constexpr double rail = 3.55, edge = 1.15, width = 1.9;

/// How much wider the cloth is than its curtain, and how wide the map is on it.
constexpr double fullness = 1.6, map_size = 1.5;

std::size_t dye_of(const SurfaceSettings& settings) {
  return static_cast<std::size_t>(std::ranges::find(dyes, settings.parameters.word("dye")) - dyes.begin());
}

Jacquard cloth(const SurfaceSettings& settings) { return {glm::ivec2{200}, {4, 3}, settings.seed}; }

Image normals(const SurfaceSettings& settings) {
  const Jacquard silk = cloth(settings);
  return fill_normals(settings.resolution, [&](const glm::dvec2& uv) { return Jacquard::normal(silk.at(uv), 0.5); });
}

Image base_color(const SurfaceSettings& settings) {
  static constexpr std::array<glm::dvec3, 3> grounds{{{0.34, 0.015, 0.02}, {0.02, 0.16, 0.05}, {0.02, 0.05, 0.26}}};
  const glm::dvec3 ground = grounds.at(dye_of(settings));
  const Jacquard silk = cloth(settings);
  return fill_colors(glm::ivec2{settings.resolution}, [&](const glm::dvec2& uv) {
    const Thread thread = silk.at(uv);
    const double shade = (1.0 - 0.35 * thread.across * thread.across) * (0.8 + 0.4 * thread.uneven);
    return glm::min(shade * (thread.weft ? glm::dvec3{0.40, 0.25, 0.07} : ground), 1.0);
  });
}

Image exponents(const SurfaceSettings& settings) {
  const Jacquard silk = cloth(settings);
  return fill_values(glm::ivec2{settings.resolution}, [&](const glm::dvec2& uv) {
    const Thread thread = silk.at(uv);
    return (thread.weft ? 120.0 : 18.0) * std::exp2(2.0 * thread.uneven - 1.0);
  });
}

/// One curtain in its arch, seen from the nave; `side` -1 hangs on the left.
Mesh curtain(double side, int index, const PeriodicNoise& noise) {
  return grid_mesh(96, 48, [&](const glm::dvec2& st) {
    const HeightPoint at{st};
    const Height fall = 1.0 - at.y;
    const Height wander = noise.at(2.0 * at.x + 3.0 * index, 1.4 * fall + 4.0 * (side + 1.0));
    const Height wave = cos(2.0 * std::numbers::pi * (6.0 * at.x + 0.5 * wander));
    const Height depth = (0.03 + 0.06 * smooth_step(fall, 0.0, 0.7)) * wave;
    const Height across = (at.x - 0.5) * width * (1.0 + 0.08 * fall * fall);
    const BentPoint point{side * hall::arcade - side * depth, rail - (rail - edge) * fall + 0.03 * wander * fall,
                          hall::bay_middle(index) + side * across};
    return bent_vertex(point, glm::dvec2{fullness * width * st.x, (rail - edge) * (1.0 - st.y)} / map_size);
  });
}

Mesh mesh(const SurfaceSettings& settings) {
  const int dye = static_cast<int>(dye_of(settings)), count = static_cast<int>(dyes.size());
  std::mt19937_64 random(settings.seed);
  const PeriodicNoise noise(24, random);
  Mesh mesh;
  for (int i = 0; i < hall::bays; ++i) {
    if (i % count == dye) append(mesh, curtain(-1.0, i, noise));
    if ((i + 1) % count == dye) append(mesh, curtain(1.0, i, noise));
  }
  mesh.name = "curtains";
  return mesh;
}

}  // namespace

Surface surface() {
  return {.name = "hall_cloth",
          .summary = "figured curtains in the arches of a hall, one of three colours that take turns",
          .parameters = {word_option("dye", dyes, "colour of the ground, and whose turn it is")},
          .default_resolution = 1024,
          .normals = normals,
          .base_color = base_color,
          .lobe_parameter = exponents,
          .distribution = NormalDistribution::blinn_phong,
          .mesh = mesh};
}

}  // namespace footprint::surfaces::hall_cloth
