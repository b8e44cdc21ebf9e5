// Lights as the shaders read them: uniform blocks, and the views of their shadow maps. No GL.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "renderer/effects/effects.hpp"
#include "renderer/scene/scene.hpp"

namespace footprint {

/// The uniform blocks of lights in surface_lights.glsl and area_lights.glsl.
struct LightType {
  Effect effect;
  std::string_view name, shader_name, counter;
  std::size_t vectors;   ///< per light
  std::uint8_t binding;  ///< of the block
};
inline constexpr std::array<LightType, 5> light_types{{
    {Effect::point_light, "point", "point_light", "point_light_count", 2, 2},
    {Effect::spot_light, "spot", "spot_light", "spot_light_count", 4, 3},
    {Effect::directional_light, "directional", "directional_light", "directional_light_count", 2, 4},
    {Effect::area_light, "area", "area_light", "area_light_count", 6, 7},
    {Effect::area_light, "points of area", "area_point", "area_point_count", 1, 8},
}};
/// Their places in light_types.
namespace light_type {
inline constexpr std::size_t point = 0, spot = 1, directional = 2, area = 3, area_point = 4;
}

/// A value for each of light_types.
template <class Value>
using PerLightType = std::array<Value, light_types.size()>;

/// The lights of a scene by kind, in std140 layout.
struct LightBlocks {
  /// Point: position and range (0: unlimited), intensity and shadow map. Spot: as point, then direction, cone scale and
  /// offset. Directional: direction to the light, illuminance and shadow map. Area: AreaLight in area_lights.glsl,
  /// those with AreaIntegral::lobes first. Point of an area: position and number of its light, those of the last lights
  /// first.
  PerLightType<std::vector<glm::vec4>> vectors;
  std::size_t area_by_lobes = 0;  ///< lights with AreaIntegral::lobes
  std::size_t points_alone = 0;   ///< points of lights without
};

/// The points of an area light, as evenly spread as Hammersley's set: each stands for an equal share of its area.
[[nodiscard]] std::vector<glm::vec3> area_points(const AreaLight& light);

/// first_maps: the number of each light's first shadow map; empty without shadow maps.
[[nodiscard]] LightBlocks light_blocks(std::span<const Light> lights, std::span<const int> first_maps = {});

/// The projection of one shadow map, in the std140 layout of surface_lights.glsl.
struct ShadowView {
  /// World point to (u w, v w, depth, w). u and v are 0 to 1 over the map; depth is linear, 0 to 1 along the axis; w is
  /// the distance along the axis in metres, or 1 for a directional light.
  glm::mat4 world_to_map{1.0F};
  glm::vec4 axis_texel{0.0F};                        ///< unit viewing direction; edge of a texel at w = 1, metres
  glm::vec4 faces_rounding{1.0F, 0.0F, 0.0F, 0.0F};  ///< maps of the light, 1 or 6; rounding of a position, metres
};

/// The shadow maps of all lights.
struct ShadowViews {
  std::vector<ShadowView> views;
  std::vector<int> first;  ///< of each light of the scene; a light has one map or six in a row
};

/// One map per light if the scene is to one side of it, fitted to the bounds or to a narrower spot cone. Otherwise
/// the six faces of a cube around the light in OpenGL's order (+x, -x, +y, ...). Each map is a few texels wider than
/// its face, so that a comparison at a seam finds its neighbours.
[[nodiscard]] ShadowViews shadow_views(const Scene& scene);

}  // namespace footprint
