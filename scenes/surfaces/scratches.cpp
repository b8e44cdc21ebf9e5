// scratches: thin straight scratches in random directions on a flat ground.
// scratched_metal: many scratches of all depths on a slightly rough ground, after Atanasov et al. 2020, Figure 1, whose
// normal maps are not published.
#include <algorithm>
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

/// The distribution of scratches. Lengths are in map widths.
struct ScratchSettings {
  int count = 0;
  double length = 0.0;      ///< of the longest; others from two fifths of it
  double width = 0.0;       ///< of the widest; others from half of it
  double edge_slope = 0.0;  ///< at the edge of the deepest
  double shallowest = 0.0;  ///< of the shallowest, as a share of that: 0 to 1
};

/// A groove along a line, with a parabola for its cross-section. Lengths are in map widths.
struct Scratch {
  glm::dvec2 centre, direction;  ///< unit direction
  double half_length = 0.0, half_width = 0.0;
  double depth = 0.0;  ///< at its middle line
};

/// Scratches with positions, directions, sizes and depths drawn from a seed, in a grid so that a texel tests few of
/// them.
class ScratchField {
 public:
  ScratchField(const ScratchSettings& settings, std::uint64_t seed);

  /// The gradient of the deepest scratch at `uv`, within (0, 1); 0 if there is none.
  [[nodiscard]] glm::dvec2 slope_at(const glm::dvec2& uv) const;

 private:
  static constexpr int side = 128;  ///< cells along the map's width

  void add(Scratch scratch, const glm::dvec2& shift);

  WrappedGrid<std::vector<Scratch>> cells_{side, side};  ///< the scratches that may reach each cell
};

/// Depth and slope of the cut at a point; 0 without one.
struct CutSlope {
  double depth = 0.0;
  glm::dvec2 slope{0.0};
};

std::vector<Scratch> scatter(const ScratchSettings& settings, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<Scratch> scratches(static_cast<std::size_t>(settings.count));
  for (Scratch& scratch : scratches) {
    const double x = uniform(random), y = uniform(random), angle = std::numbers::pi * uniform(random);
    scratch.centre = {x, y};
    scratch.direction = {std::cos(angle), std::sin(angle)};
    scratch.half_length = 0.5 * settings.length * (0.4 + 0.6 * uniform(random));
    scratch.half_width = 0.5 * settings.width * (0.5 + 0.5 * uniform(random));
    const double share = settings.shallowest + (1.0 - settings.shallowest) * uniform(random);
    scratch.depth = 0.5 * scratch.half_width * settings.edge_slope * share;
  }
  return scratches;
}

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

ScratchField::ScratchField(const ScratchSettings& settings, std::uint64_t seed) {
  for (const Scratch& scratch : scatter(settings, seed)) {
    for (int x = -1; x <= 1; ++x) {
      for (int y = -1; y <= 1; ++y) add(scratch, glm::dvec2{x, y});
    }
  }
}

glm::dvec2 ScratchField::slope_at(const glm::dvec2& uv) const {
  CutSlope deepest;
  for (const Scratch& scratch : cells_.at(static_cast<int>(uv.x * side), static_cast<int>(uv.y * side))) {
    const CutSlope cut = cut_at(scratch, uv);
    if (cut.depth > deepest.depth) deepest = cut;
  }
  return deepest.slope;
}

// Adds the scratch's copy on the next tile, `shift` away, to the cells of this tile that it may reach.
void ScratchField::add(Scratch scratch, const glm::dvec2& shift) {
  scratch.centre += shift;
  const double reach = scratch.half_width + std::numbers::sqrt2 / 2.0 / side;  // from a cell's centre to its corner
  const glm::dvec2 extent = glm::abs(scratch.direction) * scratch.half_length + reach;
  const auto first = [&](double low) { return std::clamp(static_cast<int>(std::floor(low * side)), 0, side); };
  const auto last = [&](double high) { return std::clamp(static_cast<int>(std::ceil(high * side)), 0, side); };
  const glm::dvec2 low = scratch.centre - extent, high = scratch.centre + extent;
  for (int y = first(low.y); y < last(high.y); ++y) {
    for (int x = first(low.x); x < last(high.x); ++x) {
      const glm::dvec2 offset = (glm::dvec2{x, y} + 0.5) / static_cast<double>(side) - scratch.centre;
      const double across = scratch.direction.x * offset.y - scratch.direction.y * offset.x;
      if (std::abs(across) <= reach) cells_.at(x, y).push_back(scratch);
    }
  }
}

ScratchField scratches_of(const SurfaceSettings& settings, double shallowest) {
  const Options& parameters = settings.parameters;
  return {{.count = static_cast<int>(parameters.number("count")),
           .length = parameters.number("length"),
           .width = parameters.number("width"),
           .edge_slope = std::tan(glm::radians(parameters.number("tilt_degrees"))),
           .shallowest = shallowest},
          settings.seed};
}

}  // namespace

namespace surfaces::scratches {
namespace {

Image normals(const SurfaceSettings& settings) {
  const ScratchField scratches = scratches_of(settings, 0.5);
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

/// The ground: the finest grain, and one three times as coarse.
OctaveNoise grain_of(const SurfaceSettings& settings) {
  const Options& parameters = settings.parameters;
  const int cells = static_cast<int>(parameters.number("grain"));
  const double slope = parameters.number("grain_slope");
  const std::array<Octave, 2> octaves{{{cells, slope}, {(cells + 2) / 3, slope}}};
  std::mt19937_64 random(settings.seed + (std::uint64_t{1} << 32U));
  return OctaveNoise(octaves, random);
}

Image normals(const SurfaceSettings& settings) {
  const OctaveNoise grain = grain_of(settings);
  const ScratchField scratches = scratches_of(settings, 0.05);
  return fill_normals(settings.resolution, [&](const glm::dvec2& uv) {
    return normal_of_slope(scratches.slope_at(uv) + slope_of(grain.relief(HeightPoint{uv})));
  });
}

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
      .normals = normals,
      .mesh = square_mesh};
}

}  // namespace surfaces::scratched_metal

}  // namespace footprint
