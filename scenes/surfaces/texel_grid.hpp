// Fills a surface's square maps texel by texel, in parallel; every texel is a pure function of its place.
#pragma once

#include <functional>
#include <glm/glm.hpp>

#include "renderer/image/image.hpp"

namespace footprint {

/// The unit normal at a point of the map: x to the right, y upwards, both within (0, 1).
using NormalAt = std::function<glm::dvec3(const glm::dvec2& place)>;

/// The colour (0 to 1, linear) at such a point.
using ColorAt = std::function<glm::dvec3(const glm::dvec2& place)>;

/// The normals at the texels' centres, with weight 1. The functions are called from several threads at once.
[[nodiscard]] Image fill_normals(int resolution, const NormalAt& normal_at);

/// The colours at the texels' centres, with alpha 1.
[[nodiscard]] Image fill_colors(int resolution, const ColorAt& color_at);

/// The unit normal of a height field with gradient `slope` (rise over run along x and y).
[[nodiscard]] inline glm::dvec3 normal_of_slope(const glm::dvec2& slope) {
  return glm::normalize(glm::dvec3{-slope, 1.0});
}

}  // namespace footprint
