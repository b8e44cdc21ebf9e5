// See texel_grid.hpp.
#include "scenes/surfaces/texel_grid.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace footprint {
namespace {

Image fill(int resolution, const std::function<glm::dvec3(const glm::dvec2&)>& value_at) {
  Image image(resolution, resolution, 4, 1.0F);
  tbb::parallel_for(tbb::blocked_range<int>(0, resolution), [&](const tbb::blocked_range<int>& rows) {
    for (int y = rows.begin(); y < rows.end(); ++y) {
      for (int x = 0; x < resolution; ++x) {
        const glm::dvec2 place{(x + 0.5) / resolution, 1.0 - (y + 0.5) / resolution};
        const glm::vec3 value{value_at(place)};
        const auto texel = image.at(x, y);
        for (int c = 0; c < 3; ++c) texel[static_cast<std::size_t>(c)] = value[c];
      }
    }
  });
  return image;
}

}  // namespace

Image fill_normals(int resolution, const NormalAt& normal_at) { return fill(resolution, normal_at); }

Image fill_colors(int resolution, const ColorAt& color_at) { return fill(resolution, color_at); }

}  // namespace footprint
