// car_paint: small flat flakes, each tilted in its own direction, in paint that is smooth except for long waves. After
// the car paint of Atanasov et al. 2020, Figure 1, whose normal maps are not published.
#include <array>
#include <cmath>
#include <numbers>

#include "renderer/core/numbers.hpp"
#include "scenes/surfaces/height.hpp"
#include "scenes/surfaces/meshes.hpp"
#include "scenes/surfaces/texel_grid.hpp"

namespace footprint::surfaces::car_paint {
namespace {

/// A site of the cell structure, in single precision: there are millions.
struct Site {
  glm::vec2 place;        ///< within its square, 0 to 1
  glm::vec2 slope{0.0F};  ///< of a flake
  bool is_flake = false;  ///< else paint
};

/// Flakes are the cells of jittered sites (Worley 1996): a point belongs to the site that is nearest to it. The paint
/// between them has a relief of its own, "orange peel": waves of two widths.
class Paint {
 public:
  explicit Paint(const SurfaceSettings& settings)
      : parameters_(settings.parameters), peel_random_(settings.seed + (std::uint64_t{1} << 32U)) {
    std::mt19937_64 random(settings.seed);
    const double coverage = parameters_.number("coverage"), tilt = parameters_.number("flake_tilt");
    for (Site& site : sites_) site = drawn(random, coverage, tilt);
  }

  [[nodiscard]] glm::dvec3 normal(const glm::dvec2& uv) const {
    const Site& site = at(uv);
    return normal_of_slope(site.is_flake ? glm::dvec2(site.slope) : slope_of(peel_.relief(HeightPoint{uv})));
  }
  [[nodiscard]] double alpha(const glm::dvec2& uv) const { return at(uv).is_flake ? flake_alpha_ : base_alpha_; }

 private:
  [[nodiscard]] const Site& at(const glm::dvec2& uv) const {
    const glm::dvec2 point = uv * static_cast<double>(count_);
    const glm::ivec2 own = glm::ivec2(glm::floor(point));
    const Site* nearest = nullptr;
    double least = 1e9;
    // Sites lie in the middle halves of their squares: the own square's is 0.75 sqrt(2) = 1.06 away at most, those two
    // squares on 1.25 at least.
    for (int y = own.y - 1; y <= own.y + 1; ++y) {
      for (int x = own.x - 1; x <= own.x + 1; ++x) {
        const Site& site = sites_.at(x, y);
        const glm::dvec2 offset = glm::dvec2{x, y} + glm::dvec2(site.place) - point;
        if (const double distance = glm::dot(offset, offset); distance < least) {
          least = distance;
          nearest = &site;
        }
      }
    }
    return *nearest;
  }

  /// Slopes of a Beckmann distribution of width `tilt`: Gaussian ones of variance tilt^2 / 2 along each axis.
  static Site drawn(std::mt19937_64& random, double coverage, double tilt) {
    Site site;
    const double x = uniform(random), y = uniform(random);
    site.place = glm::vec2(0.25 + 0.5 * glm::dvec2{x, y});
    const double steepness = tilt * std::sqrt(-std::log(1.0 - uniform(random)));
    const double angle = 2.0 * std::numbers::pi * uniform(random);
    site.slope = glm::vec2(steepness * glm::dvec2{std::cos(angle), std::sin(angle)});
    site.is_flake = uniform(random) < coverage;
    return site;
  }

  const Options& parameters_;
  int count_ = static_cast<int>(parameters_.number("flakes"));
  double flake_alpha_ = parameters_.number("flake_alpha"), base_alpha_ = parameters_.number("base_alpha");
  double peel_slope_ = parameters_.number("peel");
  std::mt19937_64 peel_random_;
  OctaveNoise peel_{std::array<Octave, 2>{{{12, peel_slope_}, {40, peel_slope_}}}, peel_random_};
  WrappedGrid<Site> sites_{count_, count_};
};

}  // namespace

Surface surface() {
  return {.name = "car_paint",
          .summary = "small flat flakes, each leaning its own way, in a coat of paint with a lobe of its own",
          .parameters = {whole_option("flakes", 1024, 1, 8192, "cells for flakes along the map's width"),
                         number_option("coverage", 0.5, 0, 1, "share of the cells that contain a flake"),
                         number_option("flake_tilt", 0.2, 0, 1, "alpha of the Beckmann distribution of flakes"),
                         number_option("flake_alpha", 0.03, 1e-3, 1, "alpha of a flake's own lobe"),
                         number_option("base_alpha", 0.2, 1e-3, 1, "alpha of the lobe of the paint between flakes"),
                         number_option("peel", 0.01, 0, 1, "slope of the paint's waves, about")},
          .default_resolution = 4096,
          .normals = map_of<4, &Paint::normal>,
          .lobe_parameter = map_of<1, &Paint::alpha>,
          .distribution = NormalDistribution::beckmann,
          .mesh = square_mesh};
}

}  // namespace footprint::surfaces::car_paint
