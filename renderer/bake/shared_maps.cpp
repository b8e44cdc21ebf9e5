// The table of shared maps.
#include "renderer/bake/shared_maps.hpp"

#include <array>

#include "renderer/bake/material_maps.hpp"

namespace footprint {

std::span<const SharedMap> shared_maps() {
  static constexpr std::array<SharedMap, 4> maps{
      {{Effect::base_color_variation, "base_color_map", base_color_map_of, base_color_coordinates},
       {Effect::metallic_variation, "metallic_map", metallic_map_of, roughness_coordinates},
       {Effect::specular_variation, "specular_map", specular_map_of, specular_coordinates},
       {Effect::material_index, "material_share", material_share_of, share_coordinates}}};
  return maps;
}

}  // namespace footprint
