// Sums over texels.
#include "renderer/bake/bake_memory.hpp"

#include <algorithm>

namespace footprint {

BakeMemory bake_memory(double kept, double making) {
  return {.kept = static_cast<std::uint64_t>(kept), .baking = static_cast<std::uint64_t>(std::max(making, 2.0 * kept))};
}

double normal_texels(const Material& material) {
  return material.normal_map ? static_cast<double>(material.normal_map->image.texel_count()) : 1.0;
}

BakeMemory mean_normal_memory(const Material& material, std::size_t channel_bytes) {
  const double texels = normal_texels(material);
  return bake_memory(texels * 3.0 * static_cast<double>(channel_bytes) * mip_chain_share,
                     texels * mean_normals_in_the_making);
}

}  // namespace footprint
