// Whether anything in a scene casts shadows.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "renderer/scene/scene.hpp"
#include "renderer/visibility/occluders.hpp"

namespace footprint {

/// A straight way from a point to a light.
struct LightRay {
  glm::vec3 direction;  ///< from the point to the light, unit
  float distance;       ///< metres, infinite for a directional light
};

/// The way from `point` to `light`; none where the light sends nothing there (outside of its cone or beyond its range,
/// or black) or stands at the point itself.
[[nodiscard]] std::optional<LightRay> ray_to_light(const Light& light, const glm::vec3& point);

/// The points of a scene that the search looks at: at most `limit` triangles, spread over all, by their middle and by
/// points near their corners, and as many points again, spread over the area. Deterministic. Triangles without an area
/// and points that an alpha mask cuts out have none.
[[nodiscard]] std::vector<SurfacePoint> spread_points(const Scene& scene, const Occluders& occluders,
                                                      std::size_t limit);

/// For each light of the scene: whether something keeps it from a point that faces it. From every point a ray goes to
/// the light, if the point faces it (a double-sided one always does), and a ray away from it, which tells whether the
/// point itself keeps it from the next: so a small part over a large one is found as well as the reverse. A plane or a
/// one-sided convex body casts no shadow. Deterministic; time grows with the number of triangles up to `limit`.
[[nodiscard]] std::vector<bool> lights_casting_shadows(const Scene& scene, const Occluders& occluders,
                                                       std::size_t limit = std::size_t{1} << 16U);

/// Whether anything in a scene hides a part of what lies above the plane of a point: rays from the same points, 16
/// directions each. Deterministic.
[[nodiscard]] bool hides_surroundings(const Scene& scene, const Occluders& occluders,
                                      std::size_t limit = std::size_t{1} << 13U);

}  // namespace footprint
