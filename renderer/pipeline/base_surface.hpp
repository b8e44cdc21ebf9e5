// The base BRDF as a method: what the reference averages. It reads the finest level alone.
#pragma once

#include "renderer/pipeline/method.hpp"

namespace footprint {

/// The module of the reference. `direct` shades the same, once a pixel.
[[nodiscard]] const Method& base_surface();

/// The normal map of a material as RGBA (unit normal, weight 0 or 1); flat, 1 x 1, where it has none.
[[nodiscard]] Image normal_map_of(const Material& material);

/// The detail layer of a material, likewise.
[[nodiscard]] Image layer_map_of(const Material& material);

/// The perceptual roughness map of a material, one channel; its constant, 1 x 1, where it has none.
[[nodiscard]] Image roughness_map_of(const Material& material);

/// The metallic map of a material, one channel; its constant, 1 x 1, where it has none.
[[nodiscard]] Image metallic_map_of(const Material& material);

/// Where the maps are looked up; the defaults where a material has none.
[[nodiscard]] TextureCoordinates normal_coordinates(const Material& material);
[[nodiscard]] TextureCoordinates layer_coordinates(const Material& material);
[[nodiscard]] TextureCoordinates roughness_coordinates(const Material& material);
[[nodiscard]] TextureCoordinates base_color_coordinates(const Material& material);

/// The lobe parameter of a material whose roughness does not vary: exponent, alpha or kappa.
[[nodiscard]] float lobe_parameter(const Material& material);

/// Lobe parameter <-> alpha and slope variance per axis; the C++ twins of common_lobes.glsl.
[[nodiscard]] float lobe_from_alpha(NormalDistribution distribution, float alpha);
[[nodiscard]] float lobe_alpha(NormalDistribution distribution, float lobe);
[[nodiscard]] float lobe_variance(NormalDistribution distribution, float lobe);

}  // namespace footprint
