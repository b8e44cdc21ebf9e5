// cast_metal: bronze from a sand mould, grained and pitted, with stains of patina on a smaller map that repeats.
#include <array>
#include <cmath>

#include "scenes/surfaces/height.hpp"
#include "scenes/surfaces/meshes.hpp"
#include "scenes/surfaces/texel_grid.hpp"

namespace footprint::surfaces::cast_metal {
namespace {

/// The grain of the mould: cells along the map's width, and slope.
constexpr std::array<Octave, 4> grain{{{50, 0.03}, {180, 0.08}, {420, 0.18}, {700, 0.22}}};
constexpr std::array<Octave, 4> stains{{{3, 0.9}, {7, 0.6}, {19, 0.45}, {60, 0.35}}};

/// Size of the map of stains for 2048 x 2048 normals; in proportion for other resolutions.
constexpr glm::ivec2 stain_size{671, 457};
constexpr int grain_size = 2048;

Image normals(const SurfaceSettings& settings) { return relief_normals(settings, grain); }

/// The patina at a point of the map of stains.
class Patina {
 public:
  explicit Patina(const SurfaceSettings& settings) : random_(settings.seed + (std::uint64_t{1} << 32U)) {}

  [[nodiscard]] static glm::ivec2 size_of(const SurfaceSettings& settings) {
    const double share = static_cast<double>(settings.resolution) / grain_size;
    return glm::max(glm::ivec2(glm::round(share * glm::dvec2(stain_size))), glm::ivec2{1});
  }
  [[nodiscard]] glm::dvec3 color(const glm::dvec2& uv) const {
    return glm::mix(glm::dvec3{0.10, 0.05, 0.02}, glm::dvec3{0.10, 0.24, 0.18}, crust(uv));
  }
  [[nodiscard]] glm::dvec3 specular(const glm::dvec2& uv) const {
    return glm::mix(glm::dvec3{0.72, 0.46, 0.22}, glm::dvec3{0.05, 0.06, 0.05}, crust(uv));
  }
  [[nodiscard]] double exponent(const glm::dvec2& uv) const {
    constexpr double bright = 400.0, crusted = 8.0;
    return bright * std::pow(crusted / bright, crust(uv));
  }

 private:
  /// 0 bare and polished, 1 crusted.
  [[nodiscard]] double crust(const glm::dvec2& uv) const { return glm::smoothstep(-0.25, 0.35, noise_.value(uv)); }

  std::mt19937_64 random_;
  OctaveNoise noise_{stains, random_};
};

glm::vec2 stain_tiling(const SurfaceSettings& settings) {
  const auto repeats = static_cast<float>(settings.parameters.number("stain_repeats"));
  // The map has nearly as many texels per metre along v as along u, and repeats a whole number of times.
  return {repeats, std::round(repeats * static_cast<float>(stain_size.x) / static_cast<float>(stain_size.y))};
}

}  // namespace

Surface surface() {
  return {.name = "cast_metal",
          .summary = "grained bronze, with stains of patina on a smaller map that repeats (671 x 457 beside 2048)",
          .parameters = {number_option("steepness", 1.0, 0, 10, "factor on the slopes of the grain"),
                         whole_option("stain_repeats", 4, 1, 64,
                                      "how often the map of stains repeats along the map's width")},
          .default_resolution = grain_size,
          .normals = normals,
          .base_color = map_of<4, &Patina::color>,
          .specular = map_of<3, &Patina::specular>,
          .lobe_parameter = map_of<1, &Patina::exponent>,
          .distribution = NormalDistribution::blinn_phong,
          .map_tiling = stain_tiling,
          .mesh = square_mesh};
}

}  // namespace footprint::surfaces::cast_metal
