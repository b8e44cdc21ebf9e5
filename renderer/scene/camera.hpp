// Cameras framed on a scene's bounds, and the lights and environment of scenes that have none.
#pragma once

#include <glm/glm.hpp>
#include <variant>
#include <vector>

#include "renderer/scene/environment.hpp"
#include "renderer/scene/scene.hpp"

namespace footprint {

/// A camera framed on a scene's bounds.
struct Framing {
  glm::dvec3 direction{0.25, 0.2, 1.0};  ///< from the bounds' centre to the camera, any length but 0
  double yfov = 0.6;                     ///< radians
  double margin = 1.05;                  ///< distance relative to the smallest that shows all eight corners
  double aspect = 1.0;                   ///< width / height of the frame to fill
};

/// A camera at a place in the user's coordinates.
struct PlacedCamera {
  glm::dvec3 position{0.0}, target{0.0, 0.0, -1.0};  ///< which differ
  glm::dvec3 up{0.0, 1.0, 0.0};                      ///< as in `look_at`
  Camera lens{};                                     ///< everything but `world`
};

/// The camera: the model's own (framed if it has none), framed, or given.
using CameraSettings = std::variant<std::monostate, Framing, PlacedCamera>;

/// A camera that looks at the centre of `bounds` from the smallest distance that shows all eight corners, times the
/// margin. y is up, or +z if `direction` is vertical. Bounds without extent count as 1 m wide.
[[nodiscard]] Camera frame_bounds(const Bounds& bounds, const Framing& framing);

/// Camera to world for a camera at `position` that looks at `target`, which must differ. If `up` is parallel to the
/// view, another axis replaces it.
[[nodiscard]] glm::mat4 look_at(const glm::dvec3& position, const glm::dvec3& target, const glm::dvec3& up);

/// A key and a fill directional light and a point light, relative to the camera. A white Lambert surface at the bounds'
/// centre that faces the camera has radiance 0.8: 0.5 from the key (upper left), 0.1 from the fill (lower right) and
/// 0.2 from the point light (upper right, three radii away). Bounds without extent count as 1 m wide.
[[nodiscard]] std::vector<Light> supplied_lights(const Camera& camera, const Bounds& bounds);

/// A soft studio environment, +y up, because metal would be black under lamps: grey from a dark floor to a bright
/// ceiling, with two wide neutral lights high at the left and the right. White Lambert has radiance 0.1 to 0.5. 256 x
/// 128 texels, without lobes sharper than kappa 12.
[[nodiscard]] Environment supplied_environment();

}  // namespace footprint
