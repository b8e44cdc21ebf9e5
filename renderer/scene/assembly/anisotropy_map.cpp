// Copies texels to a common grid; makes a map of a constant width.
#include "renderer/scene/assembly/anisotropy_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/glm.hpp>
#include <utility>

#include "renderer/image/mipmap.hpp"

namespace footprint {
namespace {

// A constant width as a map with the size and the coordinates of another.
void lay_width(const TextureMap& under, Material& material) {
  const int width = under.image.width(), height = under.image.height();
  TextureMap map{"roughness of " + material.name, {}, under.coordinates};
  if (material.lobe_parameter) {
    map.image = MapTexels::packed(Image(width, height, 1, *material.lobe_parameter));
    material.lobe_parameter_map = std::move(map);
    material.lobe_parameter.reset();
    return;
  }
  Image rough(width, height, 2, material.roughness);
  for (std::size_t i = 1; i < rough.texels.size(); i += 2) rough.texels[i] = material.metallic;
  map.image = MapTexels::packed(rough);
  material.metallic_roughness_map = std::move(map);
}

// Gives the maps of anisotropy and width one size, the larger one.
void match_sizes(TextureMap& anisotropy, TextureMap& width) {
  const int columns = std::max(anisotropy.image.width(), width.image.width());
  const int rows = std::max(anisotropy.image.height(), width.image.height());
  for (TextureMap* const map : {&anisotropy, &width}) {
    if (map->image.width() == columns && map->image.height() == rows) continue;
    map->image = MapTexels::packed(nearest_texels(map->image.decoded(), columns, rows));
  }
}

}  // namespace

void lay_anisotropy(Material& material, std::vector<std::string>& warnings) {
  if (!material.anisotropy_map) return;
  if (width_map(material) == nullptr) lay_width(*material.anisotropy_map, material);
  TextureMap& width = material.lobe_parameter_map ? *material.lobe_parameter_map : *material.metallic_roughness_map;
  if (width.coordinates == material.anisotropy_map->coordinates) {
    match_sizes(*material.anisotropy_map, width);
    return;
  }
  warnings.push_back(
      fmt::format("`{}`: the map {} of anisotropy has other texture coordinates than the roughness map "
                  "{}: its mean is used, a strength of {:.3g} at {:.3g} degrees",
                  material.name, material.anisotropy_map->name, width.name, material.anisotropy->strength,
                  glm::degrees(material.anisotropy->rotation)));
  material.anisotropy_map.reset();
}

}  // namespace footprint
