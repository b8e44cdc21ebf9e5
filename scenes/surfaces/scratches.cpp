// scratches: thin straight scratches in random directions on a flat ground, which most of the map is.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/core/random.hpp"
#include "scenes/surfaces/meshes.hpp"
#include "scenes/surfaces/texel_grid.hpp"
#include "scenes/surfaces/wrapped_grid.hpp"

namespace footprint {
namespace {

/// A groove along a line, with a parabola for its cross-section. Lengths are in map widths.
struct Scratch {
  glm::dvec2 centre, direction;  ///< unit direction
  double half_length = 0.0, half_width = 0.0;
  double depth = 0.0;  ///< at its middle line
};

/// How deep and how steep a point is cut; a flat one is not.
struct Cut {
  double depth = 0.0;
  glm::dvec2 slope{0.0};
};

std::vector<Scratch> scatter(const SurfaceSettings& settings) {
  const Options& parameters = settings.parameters;
  const double edge_slope = std::tan(glm::radians(parameters.number("tilt_degrees")));
  std::mt19937_64 random(settings.seed);
  std::vector<Scratch> scratches(static_cast<std::size_t>(parameters.number("count")));
  for (Scratch& scratch : scratches) {
    const double x = uniform(random), y = uniform(random), angle = std::numbers::pi * uniform(random);
    scratch.centre = {x, y};
    scratch.direction = {std::cos(angle), std::sin(angle)};
    scratch.half_length = 0.5 * parameters.number("length") * (0.4 + 0.6 * uniform(random));
    scratch.half_width = 0.5 * parameters.number("width") * (0.5 + 0.5 * uniform(random));
    scratch.depth = 0.5 * scratch.half_width * edge_slope * (0.5 + 0.5 * uniform(random));
  }
  return scratches;
}

Cut cut_at(const Scratch& scratch, const glm::dvec2& uv) {
  const glm::dvec2 across_direction{-scratch.direction.y, scratch.direction.x};
  const glm::dvec2 offset = uv - scratch.centre;
  const double along = glm::dot(offset, scratch.direction) / scratch.half_length;
  const double across = glm::dot(offset, across_direction) / scratch.half_width;
  if (std::abs(along) >= 1.0 || std::abs(across) >= 1.0) return {};
  // Height -depth (1 - across^2); a scratch's ends are too small a part of it to be given a shape.
  return {scratch.depth * (1.0 - across * across),
          2.0 * scratch.depth * across / scratch.half_width * across_direction};
}

/// Which scratches may reach each cell of a grid over the map, so that a texel asks few of them.
class ScratchGrid {
 public:
  explicit ScratchGrid(const std::vector<Scratch>& scratches) {
    for (const Scratch& scratch : scratches) {
      for (int x = -1; x <= 1; ++x) {
        for (int y = -1; y <= 1; ++y) add(scratch, glm::dvec2{x, y});
      }
    }
  }

  /// The deepest cut at `uv`.
  [[nodiscard]] Cut at(const glm::dvec2& uv) const {
    Cut deepest;
    for (const Scratch& scratch : cells_.at(static_cast<int>(uv.x * side), static_cast<int>(uv.y * side))) {
      const Cut cut = cut_at(scratch, uv);
      if (cut.depth > deepest.depth) deepest = cut;
    }
    return deepest;
  }

 private:
  static constexpr int side = 64;

  /// Adds the scratch's copy on the next tile, `shift` away, to the cells of this tile that it may reach.
  void add(Scratch scratch, const glm::dvec2& shift) {
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

  WrappedGrid<std::vector<Scratch>> cells_{side, side};
};

Image normals(const SurfaceSettings& settings) {
  const ScratchGrid scratches(scatter(settings));
  return fill_normals(settings.resolution,
                      [&](const glm::dvec2& uv) { return normal_of_slope(scratches.at(uv).slope); });
}

}  // namespace

Surface scratches_surface() {
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

}  // namespace footprint
