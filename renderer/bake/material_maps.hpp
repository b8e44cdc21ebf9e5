// The maps of a material as images of one form, their coordinates, the table of those that all methods share, and the
// weights that filter colour together with the lobe.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "renderer/effects/effects.hpp"
#include "renderer/image/image.hpp"
#include "renderer/scene/material.hpp"

namespace footprint {

/// The normal map of a material as RGBA (unit normal, weight 0 or 1); without one: flat, 1 x 1.
[[nodiscard]] Image normal_map_of(const Material& material);

/// The detail layer of a material, in the same form.
[[nodiscard]] Image layer_map_of(const Material& material);

/// The perceptual roughness map of a material, one channel; without one: its constant, 1 x 1. A map of lobe parameters
/// is converted to the roughness of the same lobes (`lobe_roughness`), and an anisotropic lobe to a round one
/// (`lobe_of`).
[[nodiscard]] Image roughness_map_of(const Material& material);

/// The stretches of a material's lobes (stretch_of), 2 channels, one for each texel of roughness_map_of; 0 if they are
/// round.
[[nodiscard]] Image stretch_map_of(const Material& material);

/// The lobe parameters of roughness_map_of, given or converted from roughness; one channel.
[[nodiscard]] Image lobe_parameter_map_of(const Material& material);

/// The base-colour map, RGBA; without one: white, 1 x 1.
[[nodiscard]] Image base_color_map_of(const Material& material);

/// The material's share of its surface (SurfaceShare::map); without one: 1, 1 x 1.
[[nodiscard]] Image material_share_of(const Material& material);

/// The metallic map of a material, one channel; without one: its constant, 1 x 1.
[[nodiscard]] Image metallic_map_of(const Material& material);

/// The factor of the dielectric specular colour, 3 channels; without a map: white, 1 x 1.
[[nodiscard]] Image specular_map_of(const Material& material);

/// The factor of the emitted light, 3 channels; without a map: white, 1 x 1.
[[nodiscard]] Image emission_map_of(const Material& material);

/// The share of the environment's light that arrives, 1 channel; without a map: 1, 1 x 1.
[[nodiscard]] Image occlusion_map_of(const Material& material);

/// The weight of a material's coat, 1 channel; without a coat: 0, 1 x 1.
[[nodiscard]] Image coat_weight_map_of(const Material& material);

/// GGX's alpha squared of the coat, 1 channel, at least `smallest_coat_alpha` squared. It is linear in the slope
/// variance, so that means over texels are means over facets.
[[nodiscard]] Image coat_width_map_of(const Material& material);

/// The coat's unit normals, 3 channels; flat for invalid texels; without a map: flat, 1 x 1.
[[nodiscard]] Image coat_normal_map_of(const Material& material);

/// Alpha of the narrowest coat, equal to smallest_alpha in common_lobes.glsl.
inline constexpr float smallest_coat_alpha = 1e-3F;

/// The base lobe of a material, or that of its mean roughness if the roughness varies.
[[nodiscard]] Lobe mean_lobe(const Material& material);

/// Whether each texel of the normal map has one texel of the roughness map above it: both have the same coordinates,
/// and the roughness map is not finer.
[[nodiscard]] bool roughness_lies_on_normals(const Material& material);

/// A wrap mode as shaders read it: 0 repeats, 1 mirrors every other copy, 2 clamps to the edge.
[[nodiscard]] float wrap_number(Wrap wrap);

/// The texture coordinates of the maps; defaults for missing maps.
[[nodiscard]] TextureCoordinates normal_coordinates(const Material& material);
[[nodiscard]] TextureCoordinates layer_coordinates(const Material& material);
[[nodiscard]] TextureCoordinates roughness_coordinates(const Material& material);
[[nodiscard]] TextureCoordinates base_color_coordinates(const Material& material);
[[nodiscard]] TextureCoordinates specular_coordinates(const Material& material);
[[nodiscard]] TextureCoordinates emission_coordinates(const Material& material);
[[nodiscard]] TextureCoordinates occlusion_coordinates(const Material& material);
[[nodiscard]] TextureCoordinates coat_weight_coordinates(const Material& material);
[[nodiscard]] TextureCoordinates coat_width_coordinates(const Material& material);
[[nodiscard]] TextureCoordinates coat_normal_coordinates(const Material& material);
[[nodiscard]] TextureCoordinates share_coordinates(const Material& material);

/// A map that the shared shaders read if an effect is on.
struct SharedMap {
  Effect effect;
  std::string_view name;            ///< of the sampler
  Image (*image)(const Material&);  ///< the finest level; a constant, 1 x 1, for a material without the map
  TextureCoordinates (*coordinates)(const Material&);
};

/// All of them, in the order of their texture units.
[[nodiscard]] std::span<const SharedMap> shared_maps();

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
