// Triangles of a grid over one period, and the two triangles of each quadrilateral of a strip.
#include "renderer/microgeometry/patch_builders.hpp"

#include <utility>

namespace footprint {

void add_grid(Patch& patch, int columns, int rows, std::uint8_t paint,
              const std::function<glm::vec3(int, int)>& point) {
  const auto base = static_cast<std::uint32_t>(patch.vertices.size());
  const auto stride = static_cast<std::uint32_t>(columns) + 1;
  for (int v = 0; v <= rows; ++v) {
    for (int u = 0; u <= columns; ++u) patch.vertices.push_back(point(u, v));
  }
  const auto add = [&](const glm::uvec3& triangle) {
    patch.triangles.push_back(triangle);
    if (facet_plane(patch, patch.triangles.size() - 1).area > 0.0) {
      patch.paints.push_back(paint);
    } else {
      patch.triangles.pop_back();
    }
  };
  for (std::uint32_t v = 0; v < static_cast<std::uint32_t>(rows); ++v) {
    for (std::uint32_t u = 0; u + 1 < stride; ++u) {
      const std::uint32_t corner = base + v * stride + u;
      add({corner, corner + 1, corner + stride + 1});
      add({corner, corner + stride + 1, corner + stride});
    }
  }
}

Patch height_field_patch(std::string name, int columns, int rows, const std::function<double(double, double)>& height) {
  Patch patch;
  patch.name = std::move(name);
  add_grid(patch, columns, rows, 0, [&](int u, int v) {
    const double x = static_cast<double>(u) / columns;
    const double y = static_cast<double>(v) / rows;
    // The last column repeats the first: evaluating it there keeps the border shut whatever rounding does.
    return glm::vec3(glm::dvec3(x, y, height(u == columns ? 0.0 : x, v == rows ? 0.0 : y)));
  });
  return patch;
}

}  // namespace footprint
