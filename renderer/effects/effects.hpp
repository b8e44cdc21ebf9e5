// Which effects a scene calls for, and why: the set that passes, textures and shader text follow.
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/scene/scene.hpp"

namespace footprint {

/// A feature that the renderer can simulate and a scene may lack.
enum class Effect : std::size_t {
  diffuse,                ///< a facet's Lambert term
  fresnel,                ///< Schlick's term over F0
  masking_shadowing,      ///< the geometry term of the base BRDF
  normal_variation,       ///< a normal map that is not flat
  normal_layers,          ///< a detail layer over the normal map
  roughness_variation,    ///< a map of roughness or of lobe parameters that is not constant
  multi_lobe,             ///< facets with several lobes, or one whose axis is not their normal
  anisotropic_lobe,       ///< facets with a lobe that is wider along one direction
  anisotropy_variation,   ///< a map of how that lobe is stretched that is not constant
  base_color_variation,   ///< a base-colour map
  vertex_color,           ///< vertex colours, which multiply the base colour
  metallic_variation,     ///< a metallic map that is not constant
  specular_variation,     ///< a map of reflectance at normal incidence that is not constant
  clear_coat,             ///< a clear layer over the material
  coat_weight_variation,  ///< a map of the coat's weight that is not constant
  coat_width_variation,   ///< a map of the coat's roughness that is not constant
  coat_normal_variation,  ///< a normal map of the coat that is not flat
  material_index,         ///< several materials on one surface, chosen by a map of indices
  alpha_mask,             ///< parts cut out by alpha
  double_sided,           ///< surfaces seen from behind
  unlit,                  ///< surfaces that radiate their colour, whatever the light
  emission,               ///< surfaces that radiate light besides what they reflect
  emission_variation,     ///< a map of that light that is not constant
  occlusion,              ///< a map of how much of the environment reaches a surface
  point_light,
  spot_light,
  directional_light,
  area_light,
  cast_shadow,               ///< parts of the scene that hide lights from others
  environment_light,         ///< light from all directions
  microgeometry_visibility,  ///< small-scale geometry whose facets hide and shadow each other
  microgeometry_colour,      ///< small-scale geometry with its own colours
  tabulated_brdf,            ///< facets with a tabulated BRDF instead of the base BRDF
};

inline constexpr std::size_t effect_count = static_cast<std::size_t>(Effect::tabulated_brdf) + 1;
using EffectSet = std::bitset<effect_count>;

/// The name of an effect in shaders, tables and `explain`.
[[nodiscard]] std::string_view effect_name(Effect effect);

/// All effects, in the order of the enumeration.
[[nodiscard]] constexpr std::array<Effect, effect_count> all_effects() {
  std::array<Effect, effect_count> effects{};
  for (std::size_t i = 0; i < effect_count; ++i) effects[i] = static_cast<Effect>(i);
  return effects;
}

[[nodiscard]] inline bool has(const EffectSet& set, Effect effect) {
  return set.test(static_cast<std::size_t>(effect));
}

/// All effects except those of `left_out`.
[[nodiscard]] inline EffectSet all_effects_but(std::initializer_list<Effect> left_out) {
  EffectSet set;
  set.set();
  for (const Effect effect : left_out) set.reset(static_cast<std::size_t>(effect));
  return set;
}

/// All effects except those of `left_out` and of small-scale geometry, for methods that only read maps.
[[nodiscard]] inline EffectSet map_effects_but(std::initializer_list<Effect> left_out) {
  return all_effects_but(left_out) &
         all_effects_but({Effect::microgeometry_visibility, Effect::microgeometry_colour, Effect::tabulated_brdf});
}

/// One effect of a scene: on or off, and the reason in words ("the normal map is constant").
struct EffectDecision {
  Effect effect;
  bool on;
  std::string reason;
};

/// All effects with decisions, in the order of the enumeration. Depends only on the scene's values. Rays may be traced
/// to decide whether anything casts a shadow. Throws Error (machine): out of memory.
[[nodiscard]] std::vector<EffectDecision> derive_effects(const Scene& scene);

/// The effects that are on.
[[nodiscard]] EffectSet effects_on(const std::vector<EffectDecision>& decisions);

/// The names of the effects of `set`, in order.
[[nodiscard]] std::vector<std::string> effect_names(const EffectSet& set);

}  // namespace footprint
