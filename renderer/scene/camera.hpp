// Cameras framed on a scene's bounds, and the lights and environment of scenes that have none.
#pragma once

#include <glm/glm.hpp>
#include <variant>
#include <vector>

#include "renderer/scene/environment.hpp"
#include "renderer/scene/scene.hpp"

namespace footprint {

/// How a camera is framed on a scene's bounds.
struct Framing {
  glm::dvec3 direction{0.25, 0.2, 1.0};  ///< from the bounds' centre to the camera, any length but 0
  double yfov = 0.6;                     ///< radians
  double margin = 1.05;                  ///< distance over the smallest that shows all eight corners
  double aspect = 1.0;                   ///< width / height of the frame to fill
};

/// Where the camera stands: the model's own (or framed, where it has none), framed, or as given.
using CameraSettings = std::variant<std::monostate, Framing, Camera>;

/// The camera (y up, +z up where `direction` is vertical) that looks at the centre of `bounds` from the smallest
/// distance at which all eight corners lie in the frame, times the margin. Bounds without extent count as 1 m wide.
[[nodiscard]] Camera frame_bounds(const Bounds& bounds, const Framing& framing);

/// Camera to world: at `position`, looking at `target`, `up` upwards as far as can be. Where up is parallel to the
/// view, another axis stands in. `position` and `target` must differ.
[[nodiscard]] glm::mat4 look_at(const glm::dvec3& position, const glm::dvec3& target, const glm::dvec3& up);

/// A key and a fill directional light and a point light, placed relative to the camera and sized by the bounds so that
/// a white Lambert surface at the bounds' centre that faces the camera has radiance 0.8: 0.5 of it by the key (from the
/// upper left), 0.1 by the fill (from the lower right), 0.2 by the point light (up right, three radii away).
[[nodiscard]] std::vector<Light> supplied_lights(const Camera& camera, const Bounds& bounds);

/// Soft light from all around, +y up, for what mirrors and would be black under lamps alone: grey from a dark floor to
/// a bright ceiling, and two wide, neutral lights high at the left and the right. White Lambert has radiance 0.1 to 0.5
/// in it. 256 x 128, smooth: no lobe in it is sharper than 12.
[[nodiscard]] Environment supplied_environment();

}  // namespace footprint
