// A frame whose pixels are counts, and their mean.
#include "renderer/pipeline/pixel_work.hpp"

namespace footprint {

PixelWork pixel_work(const FrameRenderer& counting, const View& view) {
  const Image counts = counting.render(view);
  PixelWork sum;
  std::size_t pixels = 0;
  for (std::size_t i = 0; i < counts.texels.size(); i += 4) {
    if (counts.texels[i + 3] < 1.0F) continue;
    sum.lookups += counts.texels[i];
    sum.lobes += counts.texels[i + 1];
    ++pixels;
  }
  if (pixels == 0) return {};
  return {sum.lookups / static_cast<double>(pixels), sum.lobes / static_cast<double>(pixels)};
}

}  // namespace footprint
