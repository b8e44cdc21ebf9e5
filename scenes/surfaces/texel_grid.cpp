// Evaluates a function at the centre of every texel, v upwards, with rows in parallel.
#include "scenes/surfaces/texel_grid.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "renderer/core/process.hpp"

namespace footprint {
namespace {

/// Fills `Count` channels; a further one, if `channels` is larger, is 1.
template <int Count, typename ValueAtUv>
Image fill(glm::ivec2 size, int channels, const ValueAtUv& value_at) {
  Image image(size.x, size.y, channels, 1.0F);
  tbb::parallel_for(tbb::blocked_range<int>(0, size.y), [&](const tbb::blocked_range<int>& rows) {
    for (int y = rows.begin(); y < rows.end(); ++y) {
      throw_if_interrupted();
      for (int x = 0; x < size.x; ++x) {
        const glm::vec<Count, double> value{value_at(glm::dvec2{(x + 0.5) / size.x, 1.0 - (y + 0.5) / size.y})};
        const auto texel = image.at(x, y);
        for (int c = 0; c < Count; ++c) texel[static_cast<std::size_t>(c)] = static_cast<float>(value[c]);
      }
    }
  });
  return image;
}

}  // namespace

Image fill_normals(int resolution, const NormalAt& normal_at) { return fill<3>(glm::ivec2{resolution}, 4, normal_at); }

Image flat_normals(const SurfaceSettings& settings) {
  return fill_normals(settings.resolution, [](const glm::dvec2&) { return glm::dvec3{0.0, 0.0, 1.0}; });
}

Image fill_colors(glm::ivec2 size, const ColorAt& color_at) { return fill<3>(size, 4, color_at); }

Image fill_rgb(glm::ivec2 size, const ColorAt& color_at) { return fill<3>(size, 3, color_at); }

Image fill_values(glm::ivec2 size, const ValueAt& value_at) { return fill<1>(size, 1, value_at); }

}  // namespace footprint
