// The table of shared maps.
#include "renderer/bake/shared_maps.hpp"

#include <array>

#include "renderer/bake/material_maps.hpp"

namespace footprint {

std::span<const SharedMap> shared_maps() {
  static constexpr std::array<SharedMap, 7> maps{
      {{Effect::base_color_variation, "base_color_map", base_color_map_of, base_color_coordinates},
       {Effect::metallic_variation, "metallic_map", metallic_map_of, roughness_coordinates},
       {Effect::specular_variation, "specular_map", specular_map_of, specular_coordinates},
       {Effect::coat_weight_variation, "coat_weight_map", coat_weight_map_of, coat_weight_coordinates},
       {Effect::coat_width_variation, "coat_width_map", coat_width_map_of, coat_width_coordinates},
       {Effect::coat_normal_variation, "coat_normal_map", coat_normal_map_of, coat_normal_coordinates},
       {Effect::material_index, "material_share", material_share_of, share_coordinates}}};
  return maps;
}

}  // namespace footprint
