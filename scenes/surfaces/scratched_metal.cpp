// scratched_metal: many thin scratches of all directions and depths over a ground that is itself a little rough. After
// the scratched metal of Atanasov et al. 2020, Figure 1, whose normal maps are not published.
#include <array>
#include <cmath>

#include "scenes/surfaces/meshes.hpp"
#include "scenes/surfaces/octaves.hpp"
#include "scenes/surfaces/scratch_field.hpp"
#include "scenes/surfaces/texel_grid.hpp"

namespace footprint::surfaces::scratched_metal {
namespace {

/// The ground: the finest grain, and one three times as coarse.
OctaveNoise grain_of(const SurfaceSettings& settings) {
  const Options& parameters = settings.parameters;
  const int cells = static_cast<int>(parameters.number("grain"));
  const double slope = parameters.number("grain_slope");
  const std::array<Octave, 2> octaves{{{cells, slope}, {(cells + 2) / 3, slope}}};
  std::mt19937_64 random(settings.seed + (std::uint64_t{1} << 32U));
  return OctaveNoise(octaves, random);
}

Image normals(const SurfaceSettings& settings) {
  const Options& parameters = settings.parameters;
  const OctaveNoise grain = grain_of(settings);
  const ScratchField scratches({.count = static_cast<int>(parameters.number("count")),
                                .length = parameters.number("length"),
                                .width = parameters.number("width"),
                                .edge_slope = std::tan(glm::radians(parameters.number("tilt_degrees"))),
                                .shallowest = 0.05},
                               settings.seed);
  return fill_normals(settings.resolution, [&](const glm::dvec2& uv) {
    return normal_of_slope(scratches.slope_at(uv) + slope_of(grain.relief(HeightPoint{uv})));
  });
}

}  // namespace

Surface surface() {
  return {
      .name = "scratched_metal",
      .summary = "many thin scratches of all directions and depths over a slightly rough ground",
      .parameters = {whole_option("count", 6000, 0, 200000, "scratches on the map"),
                     number_option("width", 8e-4, 1e-5, 0.1, "of the widest scratch, in map widths"),
                     number_option("length", 0.15, 0.01, 1, "of the longest scratch, in map widths"),
                     number_option("tilt_degrees", 35.0, 0, 89, "tilt at the edge of the deepest scratch, degrees"),
                     whole_option("grain", 1500, 1, 8192, "cells of the ground's finest grain along the map's width"),
                     number_option("grain_slope", 0.06, 0, 2, "slope of the grain, about")},
      .default_resolution = 4096,
      .normals = normals,
      .mesh = square_mesh};
}

}  // namespace footprint::surfaces::scratched_metal
