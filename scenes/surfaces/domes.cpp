// scales: hemispheres in staggered rows on a flat ground. Seen from above, a hemisphere has every normal, its x and y
// uniform over the unit disc; the ground is a spike at the pole.
// studs: metal domes, satin to polished, on a matt ground: normals and BRDF vary together.
#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <optional>

#include "renderer/core/numbers.hpp"
#include "scenes/surfaces/meshes.hpp"
#include "scenes/surfaces/texel_grid.hpp"

namespace footprint {
namespace {

/// The part of a dome that covers a point.
struct DomePart {
  glm::dvec2 offset;  ///< from the dome's middle, as a share of its radius; shorter than 1
  double chance;      ///< random number of this dome, uniform in 0 to 1
};

/// Rows of domes over the unit square, each odd row moved by half a column.
class DomeLattice {
 public:
  /// The number of rows is even, so that the map tiles, and makes the lattice nearly hexagonal. Parameters: `count` of
  /// columns; `fill`, the radius of the largest dome as a share of that of touching ones; `edge_degrees`, the tilt at a
  /// dome's edge; `variation`, how much smaller than the largest the smallest dome is, 0.15 without it.
  explicit DomeLattice(const SurfaceSettings& settings)
      : edge_(std::sin(glm::radians(settings.parameters.number("edge_degrees")))),
        columns_(static_cast<int>(settings.parameters.number("count"))) {
    const double across = 1.0 / domes_.columns(), up = 1.0 / domes_.rows();
    const double room = 0.5 * std::min({across, std::hypot(0.5 * across, up), 2.0 * up});  // radius of touching discs
    const double largest = settings.parameters.number("fill") * room;
    const bool varies = settings.parameters.all().contains("variation");
    const double variation = varies ? settings.parameters.number("variation") : 0.15;
    std::mt19937_64 random(settings.seed);
    for (Dome& dome : domes_) {
      dome.radius = largest * (1.0 - variation * uniform(random));
      const double angle = 2.0 * std::numbers::pi * uniform(random);
      dome.offset = (room - dome.radius) * uniform(random) * glm::dvec2{std::cos(angle), std::sin(angle)};
    }
    for (Dome& dome : domes_) dome.chance = uniform(random);
  }

  /// The normal of a sphere; a tilt of 90 degrees at their edges makes them hemispheres.
  [[nodiscard]] glm::dvec3 normal(const glm::dvec2& uv) const {
    const auto dome = at(uv);
    if (!dome) return {0.0, 0.0, 1.0};
    const glm::dvec2 tilt = edge_ * dome->offset;
    return glm::dvec3{tilt, std::sqrt(1.0 - glm::dot(tilt, tilt))};
  }

  /// The dome that covers `uv`, if any.
  [[nodiscard]] std::optional<DomePart> at(const glm::dvec2& uv) const {
    const int row = static_cast<int>(uv.y * domes_.rows()), column = static_cast<int>(uv.x * domes_.columns());
    for (int y = row - 1; y <= row + 1; ++y) {
      for (int x = column - 1; x <= column + 1; ++x) {
        const Dome& dome = domes_.at(x, y);
        const double shift = y % 2 == 0 ? 0.25 : 0.75;  // of a column
        const glm::dvec2 centre{(x + shift) / domes_.columns(), (y + 0.5) / domes_.rows()};
        const glm::dvec2 offset = (uv - centre - dome.offset) / dome.radius;
        if (glm::dot(offset, offset) < 1.0) return DomePart{offset, dome.chance};
      }
    }
    return std::nullopt;
  }

 private:
  struct Dome {
    glm::dvec2 offset;  ///< from its point of the lattice
    double radius = 0.0;
    double chance = 0.0;
  };

  double edge_;
  int columns_;
  WrappedGrid<Dome> domes_{columns_, 2 * std::max(1, static_cast<int>(std::lround(columns_ / std::numbers::sqrt3)))};
};

}  // namespace

namespace surfaces::scales {

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
      .normals = map_of<4, &DomeLattice::normal>,
      .mesh = square_mesh};
}

}  // namespace surfaces::scales

namespace surfaces::studs {
namespace {

/// The material of a point.
struct Stuff {
  glm::dvec3 albedo, specular;
  double exponent;
};

constexpr Stuff ground{{0.02, 0.12, 0.20}, {0.04, 0.04, 0.04}, 12.0};
constexpr Stuff gold{{0.16, 0.09, 0.02}, {0.72, 0.48, 0.16}, 0.0}, steel{{0.05, 0.05, 0.055}, {0.42, 0.43, 0.46}, 0.0};

/// Exponents of the dullest and the most polished stud.
constexpr double dullest = 24.0, glossiest = 600.0;

struct Studs {
  explicit Studs(const SurfaceSettings& settings) : domes(settings) {}

  [[nodiscard]] glm::dvec3 color(const glm::dvec2& uv) const { return stuff(uv).albedo; }
  [[nodiscard]] glm::dvec3 specular(const glm::dvec2& uv) const { return stuff(uv).specular; }
  [[nodiscard]] double exponent(const glm::dvec2& uv) const { return stuff(uv).exponent; }

 private:
  [[nodiscard]] Stuff stuff(const glm::dvec2& uv) const {
    const auto dome = domes.at(uv);
    if (!dome) return ground;
    Stuff stuff = dome->chance < 0.5 ? gold : steel;
    const double polish = 2.0 * dome->chance - std::floor(2.0 * dome->chance);
    stuff.exponent = dullest * std::pow(glossiest / dullest, polish);
    return stuff;
  }

  DomeLattice domes;
};

}  // namespace

Surface surface() {
  return {.name = "studs",
          .summary = "hemispherical metal studs, satin to polished, on a matt ground",
          .parameters = {whole_option("count", 48, 1, 1024, "studs along the map's width"),
                         number_option("fill", 0.85, 0.1, 1,
                                       "radius of the largest stud as a share of that of touching ones"),
                         number_option("edge_degrees", 90.0, 0, 90, "tilt at a stud's edge, degrees; 90: hemispheres")},
          .default_resolution = 1024,
          .normals = map_of<4, &DomeLattice::normal>,
          .base_color = map_of<4, &Studs::color>,
          .specular = map_of<3, &Studs::specular>,
          .lobe_parameter = map_of<1, &Studs::exponent>,
          .distribution = NormalDistribution::blinn_phong,
          .mesh = square_mesh};
}

}  // namespace surfaces::studs

}  // namespace footprint
