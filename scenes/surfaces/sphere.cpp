// sphere: a ball without relief.
#include <array>

#include "scenes/surfaces/meshes.hpp"
#include "scenes/surfaces/texel_grid.hpp"

namespace footprint::surfaces::sphere {
namespace {

Mesh mesh(const SurfaceSettings& /*settings*/) {
  // Two quarters of a circle, so that no arc is a whole half turn.
  static const double eighth = std::tan(std::numbers::pi / 8.0);
  const std::array<Cut, 2> cuts{{{{1.0, 0.0}, eighth}, {{0.0, 1.0}, eighth}}};
  Mesh mesh = turned_mesh({.start = -1.0, .cuts = cuts}, 96, 0.0333);
  mesh.name = "sphere";
  return mesh;
}

}  // namespace

Surface surface() {
  return {.name = "sphere",
          .summary = "a ball of radius 1 m without relief; the map runs around its upright axis",
          .parameters = {},
          .default_resolution = 512,
          .normals = flat_normals,
          .mesh = mesh};
}

}  // namespace footprint::surfaces::sphere
