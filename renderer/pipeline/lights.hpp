// Lights as the shaders read them: uniform blocks, and the views of their shadow maps. No GL.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "renderer/scene/scene.hpp"

namespace footprint {

/// Vectors per area light in LightBlocks.
inline constexpr std::size_t area_light_vectors = 6;

/// The lights of a scene by kind, in the std140 layout of surface_lights.glsl.
struct LightBlocks {
  std::vector<glm::vec4> point;        ///< 2 per light: position and range (0: unlimited), intensity and shadow map
  std::vector<glm::vec4> spot;         ///< 4 per light: as point, then direction, cone scale and offset
  std::vector<glm::vec4> directional;  ///< 2 per light: direction to the light, illuminance and shadow map
  std::vector<glm::vec4> area;  ///< 6 per light, those with AreaIntegral::lobes first: AreaLight in area_lights.glsl
  std::vector<glm::vec4>
      area_points;                ///< 1 per point: position and number of its light; those of the last lights first
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
