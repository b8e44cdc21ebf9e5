// scratches: thin straight scratches in random directions on a flat ground.
// scratched_metal: many scratches of all depths on a slightly rough ground, after Atanasov et al. 2020, Figure 1, whose
// normal maps are not published.
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <numbers>
#include <vector>

#include "renderer/core/numbers.hpp"
#include "scenes/surfaces/height.hpp"
#include "scenes/surfaces/meshes.hpp"
#include "scenes/surfaces/texel_grid.hpp"

namespace footprint {
namespace {

/// A groove along a line, with a parabola for its cross-section. Lengths are in map widths.
struct Scratch {
  glm::dvec2 centre, direction;  ///< unit direction
  double half_length = 0.0, half_width = 0.0;
  double depth = 0.0;  ///< at its middle line
};

/// Depth and slope of the cut at a point; 0 without one.
struct CutSlope {
  double depth = 0.0;
  glm::dvec2 slope{0.0};
};

CutSlope cut_at(const Scratch& scratch, const glm::dvec2& uv) {
  const glm::dvec2 across_direction{-scratch.direction.y, scratch.direction.x};
  const glm::dvec2 offset = uv - scratch.centre;
  const double along = glm::dot(offset, scratch.direction) / scratch.half_length;
  const double across = glm::dot(offset, across_direction) / scratch.half_width;
  if (std::abs(along) >= 1.0 || std::abs(across) >= 1.0) return {};
  // Height -depth (1 - across^2). The ends are too small to need a shape.
  return {scratch.depth * (1.0 - across * across),
          2.0 * scratch.depth * across / scratch.half_width * across_direction};
}

/// Scratches with positions, directions, sizes and depths drawn from a seed, in a grid so that a texel tests few of
/// them. Parameters, in map widths: `count`; `length` of the longest, others from two fifths of it; `width` of the
/// widest, others from half of it; `tilt_degrees` at the edge of the deepest.
class ScratchField {
 public:
  /// shallowest: depth of the shallowest as a share of the deepest's, 0 to 1.
  ScratchField(const SurfaceSettings& settings, double shallowest) {
    const Options& parameters = settings.parameters;
    const double length = parameters.number("length"), width = parameters.number("width");
    const double edge_slope = std::tan(glm::radians(parameters.number("tilt_degrees")));
    std::mt19937_64 random(settings.seed);
    for (int i = static_cast<int>(parameters.number("count")); i > 0; --i) {
      const double x = uniform(random), y = uniform(random), angle = std::numbers::pi * uniform(random);
      Scratch scratch{.centre = {x, y}, .direction = {std::cos(angle), std::sin(angle)}};
      scratch.half_length = 0.5 * length * (0.4 + 0.6 * uniform(random));
      scratch.half_width = 0.5 * width * (0.5 + 0.5 * uniform(random));
      scratch.depth = 0.5 * scratch.half_width * edge_slope * (shallowest + (1.0 - shallowest) * uniform(random));
      for (int tile = 0; tile < 9; ++tile) add(scratch, glm::dvec2{tile / 3 - 1, tile % 3 - 1});
    }
  }

  /// The gradient of the deepest scratch at `uv`, within (0, 1); 0 if there is none.
  [[nodiscard]] glm::dvec2 slope_at(const glm::dvec2& uv) const {
    CutSlope deepest;
    for (const Scratch& scratch : cells_.at(static_cast<int>(uv.x * side), static_cast<int>(uv.y * side))) {
      const CutSlope cut = cut_at(scratch, uv);
      if (cut.depth > deepest.depth) deepest = cut;
    }
    return deepest.slope;
  }

 private:
  static constexpr int side = 128;  ///< cells along the map's width

  /// Adds the scratch's copy on the next tile, `shift` away, to the cells of this tile that it may reach.
  void add(Scratch scratch, const glm::dvec2& shift) {
    scratch.centre += shift;
    const double reach = scratch.half_width + std::numbers::sqrt2 / 2.0 / side;  // from a cell's centre to its corner
    const glm::dvec2 extent = glm::abs(scratch.direction) * scratch.half_length + reach;
    const auto cell = [](const glm::dvec2& at) { return glm::clamp(glm::ivec2(at), 0, side); };
    const glm::ivec2 first = cell(glm::floor((scratch.centre - extent) * static_cast<double>(side)));
    const glm::ivec2 last = cell(glm::ceil((scratch.centre + extent) * static_cast<double>(side)));
    for (int y = first.y; y < last.y; ++y) {
      for (int x = first.x; x < last.x; ++x) {
        const glm::dvec2 offset = (glm::dvec2{x, y} + 0.5) / static_cast<double>(side) - scratch.centre;
        const double across = scratch.direction.x * offset.y - scratch.direction.y * offset.x;
        if (std::abs(across) <= reach) cells_.at(x, y).push_back(scratch);
      }
    }
  }

  WrappedGrid<std::vector<Scratch>> cells_{side, side};  ///< the scratches that may reach each cell
};

}  // namespace

namespace surfaces::scratches {
namespace {

Image normals(const SurfaceSettings& settings) {
  const ScratchField scratches(settings, 0.5);
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

}  // namespace surfaces::scratches

namespace surfaces::scratched_metal {
namespace {

/// Scratches in a ground with two grains: the finest one, and one three times as coarse.
class Metal {
 public:
  explicit Metal(const SurfaceSettings& settings)
      : scratches_(settings, 0.05),
        random_(settings.seed + (std::uint64_t{1} << 32U)),
        cells_(static_cast<int>(settings.parameters.number("grain"))),
        slope_(settings.parameters.number("grain_slope")) {}

  [[nodiscard]] glm::dvec3 normal(const glm::dvec2& uv) const {
    return normal_of_slope(scratches_.slope_at(uv) + slope_of(grain_.relief(HeightPoint{uv})));
  }

 private:
  ScratchField scratches_;
  std::mt19937_64 random_;
  int cells_;
  double slope_;
  OctaveNoise grain_{std::array<Octave, 2>{{{cells_, slope_}, {(cells_ + 2) / 3, slope_}}}, random_};
};

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
      .normals = map_of<4, &Metal::normal>,
      .mesh = square_mesh};
}

}  // namespace surfaces::scratched_metal

}  // namespace footprint
