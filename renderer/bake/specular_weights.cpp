// Resamples colours to another map's texels, nearest by nearest, and weighs them by luminance.
#include "renderer/bake/specular_weights.hpp"

#include <algorithm>

#include "renderer/bake/material_maps.hpp"

namespace footprint {

Image specular_weights(const Image& colours) {
  Image weights(colours.width, colours.height, 1);
  for (std::size_t i = 0; i < weights.texels.size(); ++i)
    weights.texels[i] = luminance(colours.texels[3 * i], colours.texels[3 * i + 1], colours.texels[3 * i + 2]);
  const float largest = std::max(*std::ranges::max_element(weights.texels), 1e-6F);
  for (float& weight : weights.texels) weight /= largest;
  return weights;
}

std::optional<Image> specular_over(const Material& material, const glm::ivec2& size,
                                   const TextureCoordinates& coordinates) {
  const Image own = specular_map_of(material);
  const bool elsewhere = material.specular_map && specular_coordinates(material) != coordinates;
  if (elsewhere || own.width > size.x || own.height > size.y) return {};
  Image out(size.x, size.y, 3);
  for (int y = 0; y < size.y; ++y) {
    for (int x = 0; x < size.x; ++x)
      std::ranges::copy(own.at(x * own.width / size.x, y * own.height / size.y), out.at(x, y).begin());
  }
  return out;
}

}  // namespace footprint
