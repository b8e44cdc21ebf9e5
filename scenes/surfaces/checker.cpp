// checker: two base BRDFs in a checkerboard, without relief.
#include "scenes/surfaces/meshes.hpp"
#include "scenes/surfaces/texel_grid.hpp"

namespace footprint::surfaces::checker {
namespace {

/// Whether a point is on a glossy square; the others are dull.
class Board {
 public:
  explicit Board(const SurfaceSettings& settings) : squares_(settings.parameters.number("squares")) {}

  [[nodiscard]] bool is_glossy(const glm::dvec2& uv) const {
    const glm::ivec2 square = glm::ivec2(glm::floor(squares_ * uv));
    return (square.x + square.y) % 2 == 0;
  }

 private:
  double squares_;
};

Image base_color(const SurfaceSettings& settings) {
  const Board board(settings);
  return fill_colors(glm::ivec2{settings.resolution}, [&](const glm::dvec2& uv) {
    return board.is_glossy(uv) ? glm::dvec3{0.02, 0.03, 0.06} : glm::dvec3{0.34, 0.20, 0.10};
  });
}

Image specular(const SurfaceSettings& settings) {
  const Board board(settings);
  return fill_rgb(glm::ivec2{settings.resolution}, [&](const glm::dvec2& uv) {
    return board.is_glossy(uv) ? glm::dvec3{0.5, 0.52, 0.56} : glm::dvec3{0.3, 0.24, 0.18};
  });
}

Image exponents(const SurfaceSettings& settings) {
  const Board board(settings);
  const double glossy = settings.parameters.number("glossy"), dull = settings.parameters.number("dull");
  return fill_values(glm::ivec2{settings.resolution},
                     [&](const glm::dvec2& uv) { return board.is_glossy(uv) ? glossy : dull; });
}

}  // namespace

Surface surface() {
  return {.name = "checker",
          .summary = "two base BRDFs in a checkerboard, without relief",
          .parameters = {whole_option("squares", 64, 1, 16384, "squares along the map's width; an even number tiles"),
                         number_option("glossy", 800.0, 1, 1e6, "exponent of one square's lobe"),
                         number_option("dull", 8.0, 1, 1e6, "exponent of the other's")},
          .default_resolution = 512,
          .normals = flat_normals,
          .base_color = base_color,
          .specular = specular,
          .lobe_parameter = exponents,
          .distribution = NormalDistribution::blinn_phong,
          .mesh = square_mesh};
}

}  // namespace footprint::surfaces::checker
