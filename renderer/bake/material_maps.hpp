// The maps of a material as images of one form, and their texture coordinates: the input of bakes.
#pragma once

#include "renderer/image/image.hpp"
#include "renderer/scene/material.hpp"

namespace footprint {

/// The normal map of a material as RGBA (unit normal, weight 0 or 1); flat, 1 x 1, without a map.
[[nodiscard]] Image normal_map_of(const Material& material);

/// The detail layer of a material in the same form.
[[nodiscard]] Image layer_map_of(const Material& material);

/// The perceptual roughness map of a material, one channel; its constant, 1 x 1, without a map. A map of lobe
/// parameters is converted to the roughness of the same lobes (`lobe_roughness`).
[[nodiscard]] Image roughness_map_of(const Material& material);

/// The lobe parameter at every texel of that map, given by the material or converted from roughness; one channel.
[[nodiscard]] Image lobe_parameter_map_of(const Material& material);

/// The base-colour map, RGBA; white, 1 x 1, without a map.
[[nodiscard]] Image base_color_map_of(const Material& material);

/// The share of the surface that the material has (SurfaceShare::map); 1, 1 x 1, if it has all of it.
[[nodiscard]] Image material_share_of(const Material& material);

/// The metallic map of a material, one channel; its constant, 1 x 1, without a map.
[[nodiscard]] Image metallic_map_of(const Material& material);

/// The factor on the dielectric specular colour, 3 channels; white, 1 x 1, without a map.
[[nodiscard]] Image specular_map_of(const Material& material);

/// The weight of a material's coat, 1 channel; 0, 1 x 1, without a coat.
[[nodiscard]] Image coat_weight_map_of(const Material& material);

/// GGX's alpha squared of the coat, 1 channel, at least `smallest_coat_alpha` squared. It is linear in the slope
/// variance, so that means over texels are those of the facets.
[[nodiscard]] Image coat_width_map_of(const Material& material);

/// The coat's unit normals, 3 channels; flat, 1 x 1, without a map, and flat at invalid texels.
[[nodiscard]] Image coat_normal_map_of(const Material& material);

/// The alpha of the narrowest coat, equal to that of every base lobe (smallest_alpha in common_lobes.glsl).
inline constexpr float smallest_coat_alpha = 1e-3F;

/// The base lobe of a material, or that of its mean roughness if the roughness varies.
[[nodiscard]] Lobe mean_lobe(const Material& material);

/// Whether each texel of the normal map has one texel of the roughness map above it: both have the same coordinates,
/// and the roughness map is not finer.
[[nodiscard]] bool roughness_lies_on_normals(const Material& material);

/// A wrap mode as shaders read it: 0 repeats, 1 mirrors every other copy, 2 clamps to the edge.
[[nodiscard]] float wrap_number(Wrap wrap);

/// The texture coordinates of the maps; the defaults without a map.
[[nodiscard]] TextureCoordinates normal_coordinates(const Material& material);
[[nodiscard]] TextureCoordinates layer_coordinates(const Material& material);
[[nodiscard]] TextureCoordinates roughness_coordinates(const Material& material);
[[nodiscard]] TextureCoordinates base_color_coordinates(const Material& material);
[[nodiscard]] TextureCoordinates specular_coordinates(const Material& material);
[[nodiscard]] TextureCoordinates coat_weight_coordinates(const Material& material);
[[nodiscard]] TextureCoordinates coat_width_coordinates(const Material& material);
[[nodiscard]] TextureCoordinates coat_normal_coordinates(const Material& material);
[[nodiscard]] TextureCoordinates share_coordinates(const Material& material);

}  // namespace footprint
