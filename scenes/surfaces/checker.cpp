// checker: two base BRDFs in a checkerboard, without relief.
#include "scenes/surfaces/meshes.hpp"
#include "scenes/surfaces/texel_grid.hpp"

namespace footprint::surfaces::checker {
namespace {

/// Glossy and dull squares.
struct Board {
  explicit Board(const SurfaceSettings& settings)
      : squares(settings.parameters.number("squares")),
        glossy(settings.parameters.number("glossy")),
        dull(settings.parameters.number("dull")) {}

  [[nodiscard]] bool is_glossy(const glm::dvec2& uv) const {
    const glm::ivec2 square = glm::ivec2(glm::floor(squares * uv));
    return (square.x + square.y) % 2 == 0;
  }
  [[nodiscard]] glm::dvec3 color(const glm::dvec2& uv) const {
    return is_glossy(uv) ? glm::dvec3{0.02, 0.03, 0.06} : glm::dvec3{0.34, 0.20, 0.10};
  }
  [[nodiscard]] glm::dvec3 specular(const glm::dvec2& uv) const {
    return is_glossy(uv) ? glm::dvec3{0.5, 0.52, 0.56} : glm::dvec3{0.3, 0.24, 0.18};
  }
  [[nodiscard]] double exponent(const glm::dvec2& uv) const { return is_glossy(uv) ? glossy : dull; }

  double squares, glossy, dull;
};

}  // namespace

Surface surface() {
  return {.name = "checker",
          .summary = "two base BRDFs in a checkerboard, without relief",
          .parameters = {whole_option("squares", 64, 1, 16384, "squares along the map's width; an even number tiles"),
                         number_option("glossy", 800.0, 1, 1e6, "exponent of one square's lobe"),
                         number_option("dull", 8.0, 1, 1e6, "exponent of the other's")},
          .default_resolution = 512,
          .normals = flat_normals,
          .base_color = map_of<4, &Board::color>,
          .specular = map_of<3, &Board::specular>,
          .lobe_parameter = map_of<1, &Board::exponent>,
          .distribution = NormalDistribution::blinn_phong,
          .mesh = square_mesh};
}

}  // namespace footprint::surfaces::checker
