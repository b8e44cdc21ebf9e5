// Where each light of a scene looks from when its shadow map is drawn. No GL.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderer/scene/scene.hpp"

namespace footprint {

/// What one shadow map sees, in the std140 layout of surface_shadows.glsl.
struct ShadowView {
  /// A world point to (u w, v w, depth, w): u and v are 0 to 1 over the map, depth is 0 to 1 along the axis and linear,
  /// w is the distance along the axis in metres, or 1 for a directional light.
  glm::mat4 world_to_map{1.0F};
  glm::vec4 axis_texel{0.0F};  ///< the way that the map looks, unit; the edge of a texel in metres at w = 1
  glm::vec4 faces_rounding{1.0F, 0.0F, 0.0F, 0.0F};  ///< maps of the light, 1 or 6; what rounding moves a point by, m
};

/// The maps of all lights.
struct ShadowViews {
  std::vector<ShadowView> views;
  std::vector<int> first;  ///< of each light of the scene; six maps follow for a light that has six
};

/// One map where the scene lies to one side of the light, fitted to the bounds, or to a spot light's cone where that
/// is narrower; else six, the faces of a cube around the light in OpenGL's order (+x, -x, +y, ...), each a few texels
/// wider than its face, so that a comparison at a seam finds its neighbours. Maps have `resolution` texels a side.
[[nodiscard]] ShadowViews shadow_views(const Scene& scene);

}  // namespace footprint
