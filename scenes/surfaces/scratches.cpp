// scratches: thin straight scratches in random directions on a flat ground, which most of the map is.
#include <cmath>

#include "scenes/surfaces/meshes.hpp"
#include "scenes/surfaces/scratch_field.hpp"
#include "scenes/surfaces/texel_grid.hpp"

namespace footprint::surfaces::scratches {
namespace {

Image normals(const SurfaceSettings& settings) {
  const Options& parameters = settings.parameters;
  const ScratchField scratches({.count = static_cast<int>(parameters.number("count")),
                                .length = parameters.number("length"),
                                .width = parameters.number("width"),
                                .edge_slope = std::tan(glm::radians(parameters.number("tilt_degrees")))},
                               settings.seed);
  return fill_normals(settings.resolution,
                      [&](const glm::dvec2& uv) { return normal_of_slope(scratches.slope_at(uv)); });
}

}  // namespace

Surface surface() {
  return {
      .name = "scratches",
      .summary = "thin straight scratches in random directions on a flat ground",
      .parameters = {whole_option("count", 160, 0, 10000, "scratches on the map"),
                     number_option("width", 0.004, 1e-4, 0.1, "of the widest scratch, in map widths"),
                     number_option("length", 0.4, 0.01, 1, "of the longest scratch, in map widths"),
                     number_option("tilt_degrees", 45.0, 0, 89, "tilt at the edge of the deepest scratch, degrees")},
      .normals = normals,
      .mesh = square_mesh};
}

}  // namespace footprint::surfaces::scratches
