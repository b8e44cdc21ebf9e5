// Whether anything in a scene casts shadows.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "renderer/scene/scene.hpp"
#include "renderer/visibility/occluders.hpp"

namespace footprint {

/// The ray from a point to a light.
struct LightRay {
  glm::vec3 direction;  ///< from the point to the light, unit
  float distance;       ///< metres, infinite for a directional light
};

/// The ray from `point` to `light`. None if the light does not shine there (outside of its cone or range, or black), or
/// is at the point.
[[nodiscard]] std::optional<LightRay> ray_to_light(const Light& light, const glm::vec3& point);

/// Points on the surface for the search: the middles of at most `limit` triangles and points near their corners, and as
/// many points by area. Deterministic. Skips triangles without an area and points that an alpha mask cuts out.
[[nodiscard]] std::vector<SurfacePoint> spread_points(const Scene& scene, const Occluders& occluders,
                                                      std::size_t limit);

/// For each light of the scene: whether anything casts a shadow in it. Each point sends a ray to the light if it faces
/// it (double-sided points always do), and a ray away from it, so that small parts over large ones are found as well as
/// the reverse. A plane or a one-sided convex body casts no shadow. Deterministic; the time grows with the number of
/// triangles up to `limit`.
[[nodiscard]] std::vector<bool> lights_casting_shadows(const Scene& scene, const Occluders& occluders,
                                                       std::size_t limit = std::size_t{1} << 16U);

/// Whether anything in a scene hides directions above the plane of a point: 16 rays from each of the same points.
/// Deterministic.
[[nodiscard]] bool hides_surroundings(const Scene& scene, const Occluders& occluders,
                                      std::size_t limit = std::size_t{1} << 13U);

}  // namespace footprint
