// What filters the colour of a lobe together with the lobe: texels of the other maps weigh by their specular colour.
#pragma once

#include <optional>
#include <string_view>

#include "renderer/image/image.hpp"
#include "renderer/scene/material.hpp"

namespace footprint {

/// The luminance of each texel over the largest, one channel, 0 to 1.
/// colours: RGB. If all are black, all weights are 0.
[[nodiscard]] Image specular_weights(const Image& colours);

/// The specular colours of a material (specular_map_of), RGB, one for each texel of another map. None if the map of
/// specular colours has other texture coordinates, or is finer. A material without that map has white ones.
/// size: of the other map, texels.
/// coordinates: of the other map.
[[nodiscard]] std::optional<Image> specular_over(const Material& material, const glm::ivec2& size,
                                                 const TextureCoordinates& coordinates);

/// The note of a bake that found none.
inline constexpr std::string_view specular_elsewhere_note =
    "the map of specular colours has other texture coordinates or is finer and cannot be joined; it is filtered on its "
    "own";

}  // namespace footprint
