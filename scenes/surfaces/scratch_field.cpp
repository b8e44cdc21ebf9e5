// Scratches in a grid of lists: each is entered with the cells that it may reach, and with those of the next tiles.
#include "scenes/surfaces/scratch_field.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/core/random.hpp"

namespace footprint {
namespace {

/// How deep and how steep a point is cut; a flat one is not.
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
  // Height -depth (1 - across^2); a scratch's ends are too small a part of it to be given a shape.
  return {scratch.depth * (1.0 - across * across),
          2.0 * scratch.depth * across / scratch.half_width * across_direction};
}

}  // namespace

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

}  // namespace footprint
