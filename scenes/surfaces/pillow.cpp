// pillow: a stuffed pillow in figured silk, whose threads differ in colour and gloss; the cloth itself is flat.
#include <cmath>
#include <numbers>

#include "renderer/scene/geometry.hpp"
#include "scenes/surfaces/height.hpp"
#include "scenes/surfaces/jacquard.hpp"
#include "scenes/surfaces/meshes.hpp"
#include "scenes/surfaces/texel_grid.hpp"

namespace footprint::surfaces::pillow {
namespace {

/// Metres. The map's upper half covers the front, its lower half the back.
constexpr double half_width = 0.30, half_height = 0.15, half_thickness = 0.085;

constexpr glm::dvec3 warp_color{0.30, 0.012, 0.035}, weft_color{0.42, 0.25, 0.06};

/// The map's halves are twice as wide as high: as many threads per metre each way.
struct Silk {
  explicit Silk(const SurfaceSettings& settings)
      : cloth(glm::ivec2{static_cast<int>(settings.parameters.number("threads"))}, {5, 4}, settings.seed) {}

  [[nodiscard]] glm::dvec3 color(const glm::dvec2& uv) const {
    return silk_color(cloth.at(uv), warp_color, weft_color, 0.45);
  }
  [[nodiscard]] glm::dvec3 specular(const glm::dvec2& uv) const {
    return cloth.at(uv).weft ? glm::dvec3{0.55, 0.38, 0.14} : glm::dvec3{0.06, 0.028, 0.034};
  }
  /// Silk is glossy along the weft's long floats, and dull on the warp.
  [[nodiscard]] double exponent(const glm::dvec2& uv) const { return silk_exponent(cloth.at(uv), 14.0, 220.0); }

  Jacquard cloth;
};

/// One side, `facing` 1 the front and -1 the back. (s, t) runs over the side from corner to corner, -1 to 1.
class Stuffing {
 public:
  explicit Stuffing(std::uint32_t seed) : random_(seed) {}

  [[nodiscard]] BentPoint at(const HeightPoint& point, double facing) const {
    const Height s = spread(point.x), t = spread(point.y);
    // Filling draws the sides in, which leaves the corners out.
    const Height x = half_width * s * (1.0 - 0.10 * (1.0 - t * t) * s * s);
    const Height y = half_height * t * (1.0 - 0.16 * (1.0 - s * s) * t * t);
    const Height round = cos(quarter * point.x) * cos(quarter * point.y);
    const Height dents = noise_.at(3.0 * point.x + 3.0 * facing, 1.7 * point.y);
    return {x, y, facing * half_thickness * round * (1.0 + 0.10 * dents + puckers(point, facing))};
  }

 private:
  static constexpr double quarter = std::numbers::pi / 2.0;

  /// Denser near the seams, where the side turns. The slope is never 0, so that corners have a normal.
  [[nodiscard]] static Height spread(const Height& x) { return 0.9 * sin(quarter * x) + 0.1 * x; }

  /// Short creases across the seams and long ones out of the corners.
  [[nodiscard]] Height puckers(const HeightPoint& point, double facing) const {
    const Height to_sides = point.x * point.x, to_ends = point.y * point.y;
    const Height along_sides = noise_.at(11.0 * point.y + 5.0 * facing, 0.8 * point.x);
    const Height along_ends = noise_.at(19.0 * point.x + 7.0 * facing, 0.8 * point.y);
    const Height corners = noise_.at(5.0 * (point.x - point.y) + 2.0 * facing, 5.0 * (point.x + point.y));
    return 0.5 * to_sides * to_sides * along_sides + 0.5 * to_ends * to_ends * along_ends +
           0.6 * to_sides * to_ends * corners;
  }

  std::mt19937_64 random_;
  PeriodicNoise noise_{16, random_};
};

/// Front and back meet along the seam.
Mesh mesh(const SurfaceSettings& settings) {
  constexpr int columns = 160, rows = 80;
  const Stuffing stuffing(settings.seed);
  const auto side = [&](double facing) {
    return grid_mesh(columns, rows, [&](const glm::dvec2& st) {
      const HeightPoint at{2.0 * st - 1.0};
      HeightPoint turned = at;
      turned.x *= facing;
      // Nearer to lengths along the cloth than (s, t) are.
      const auto share = [](double t) { return 0.5 + 0.5 * (0.5 * t + 0.5 * std::sin(std::numbers::pi / 2.0 * t)); };
      const double v = 1.0 - share(at.y.value());
      return bent_vertex(stuffing.at(turned, facing), {share(at.x.value()), facing > 0.0 ? 0.5 * v : 0.5 + 0.5 * v});
    });
  };
  Mesh mesh = side(1.0);
  append(mesh, side(-1.0));
  mesh.name = "pillow";
  return mesh;
}

}  // namespace

Surface surface() {
  return {.name = "pillow",
          .summary = "a stuffed pillow in figured silk: two threads that differ in colour and gloss, no relief",
          .parameters = {whole_option("threads", 320, 5, 8192,
                                      "warp threads along the map's width, and as many weft threads")},
          .default_resolution = 1024,
          .normals = flat_normals,
          .base_color = map_of<4, &Silk::color>,
          .specular = map_of<3, &Silk::specular>,
          .lobe_parameter = map_of<1, &Silk::exponent>,
          .distribution = NormalDistribution::blinn_phong,
          .mesh = mesh};
}

}  // namespace footprint::surfaces::pillow
