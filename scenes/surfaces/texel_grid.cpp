// Evaluates a function at the centre of every texel, v upwards, with rows in parallel.
#include "scenes/surfaces/texel_grid.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "renderer/core/process.hpp"

namespace footprint {

Image fill_map(glm::ivec2 size, int channels, const ValueAt& value_at) {
  Image image(size.x, size.y, channels, 1.0F);
  tbb::parallel_for(tbb::blocked_range<int>(0, size.y), [&](const tbb::blocked_range<int>& rows) {
    for (int y = rows.begin(); y < rows.end(); ++y) {
      throw_if_interrupted();
      for (int x = 0; x < size.x; ++x) {
        const glm::vec3 value{value_at(glm::dvec2{(x + 0.5) / size.x, 1.0 - (y + 0.5) / size.y})};
        std::copy_n(&value.x, std::min(channels, 3), image.at(x, y).begin());
      }
    }
  });
  return image;
}

Image flat_normals(const SurfaceSettings& settings) {
  return fill_normals(settings.resolution, [](const glm::dvec2&) { return glm::dvec3{0.0, 0.0, 1.0}; });
}

}  // namespace footprint
