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

/// Flakes are the cells of jittered sites (Worley 1996): a point belongs to the site that is nearest to it.
class Flakes {
 public:
  explicit Flakes(const SurfaceSettings& settings)
      : count_(static_cast<int>(settings.parameters.number("flakes"))), sites_(count_, count_) {
    std::mt19937_64 random(settings.seed);
    const double coverage = settings.parameters.number("coverage");
    const double tilt = settings.parameters.number("flake_tilt");
    for (Site& site : sites_) site = drawn(random, coverage, tilt);
  }

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

 private:
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

  int count_;
  WrappedGrid<Site> sites_;
};

/// The paint's own relief, "orange peel": waves of two widths.
OctaveNoise peel_of(const SurfaceSettings& settings) {
  const double slope = settings.parameters.number("peel");
  const std::array<Octave, 2> octaves{{{12, slope}, {40, slope}}};
  std::mt19937_64 random(settings.seed + (std::uint64_t{1} << 32U));
  return OctaveNoise(octaves, random);
}

Image normals(const SurfaceSettings& settings) {
  const Flakes flakes(settings);
  const OctaveNoise peel = peel_of(settings);
  return fill_normals(settings.resolution, [&](const glm::dvec2& uv) {
    const Site& site = flakes.at(uv);
    if (site.is_flake) return normal_of_slope(glm::dvec2(site.slope));
    return normal_of_slope(slope_of(peel.relief(HeightPoint{uv})));
  });
}

Image alphas(const SurfaceSettings& settings) {
  const Flakes flakes(settings);
  const double flake = settings.parameters.number("flake_alpha"), base = settings.parameters.number("base_alpha");
  return fill_values(glm::ivec2{settings.resolution},
                     [&](const glm::dvec2& uv) { return flakes.at(uv).is_flake ? flake : base; });
}

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
          .normals = normals,
          .lobe_parameter = alphas,
          .distribution = NormalDistribution::beckmann,
          .mesh = square_mesh};
}

}  // namespace footprint::surfaces::car_paint
