// The base BRDF as a method: what the reference averages. It reads the finest level alone.
#pragma once

#include "renderer/bake/method.hpp"

namespace footprint {

/// The module of the reference. `direct` shades the same, once a pixel.
[[nodiscard]] const Method& base_surface();

/// The normal map of a material as RGBA (unit normal, weight 0 or 1); flat, 1 x 1, where it has none.
[[nodiscard]] Image normal_map_of(const Material& material);

/// The detail layer of a material, likewise.
[[nodiscard]] Image layer_map_of(const Material& material);

/// The perceptual roughness map of a material, one channel; its constant, 1 x 1, where it has none. A map of lobe
/// parameters comes as the roughness of the same lobes (`roughness_from_lobe`).
[[nodiscard]] Image roughness_map_of(const Material& material);

/// The lobe parameter at every texel of that map, as the material gives it or from its roughness; one channel.
[[nodiscard]] Image lobe_parameter_map_of(const Material& material);

/// The metallic map of a material, one channel; its constant, 1 x 1, where it has none.
[[nodiscard]] Image metallic_map_of(const Material& material);

/// The factor on the dielectric specular colour, 3 channels; white, 1 x 1, where it has no such map.
[[nodiscard]] Image specular_map_of(const Material& material);

/// Where the maps are looked up; the defaults where a material has none.
[[nodiscard]] TextureCoordinates normal_coordinates(const Material& material);
[[nodiscard]] TextureCoordinates layer_coordinates(const Material& material);
[[nodiscard]] TextureCoordinates roughness_coordinates(const Material& material);
[[nodiscard]] TextureCoordinates base_color_coordinates(const Material& material);
[[nodiscard]] TextureCoordinates specular_coordinates(const Material& material);

/// The lobe parameter of a material whose roughness does not vary: exponent, alpha or kappa. Of one whose lobes have
/// axes of their own that of one lobe about the normal, with the slope variance that they have about it: what a method
/// takes that leaves `multi_lobe` out.
[[nodiscard]] float lobe_parameter(const Material& material);

/// Lobe parameter <-> alpha and slope variance per axis; the C++ twins of common_lobes.glsl.
[[nodiscard]] float lobe_from_alpha(NormalDistribution distribution, float alpha);
[[nodiscard]] float lobe_alpha(NormalDistribution distribution, float lobe);
[[nodiscard]] float lobe_variance(NormalDistribution distribution, float lobe);
[[nodiscard]] float lobe_from_variance(NormalDistribution distribution, float variance);

/// The perceptual roughness r of a lobe, so that lobe_from_alpha(r^2) is the lobe again, to 1e-6 of it (Blinn-Phong
/// exponents below 1: to 1e-6) for alpha from 1e-3 and exponents and kappa to 1e6. Above 1 for kappa below 2.
[[nodiscard]] float roughness_from_lobe(NormalDistribution distribution, float lobe);

}  // namespace footprint
