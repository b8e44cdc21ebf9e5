// The lights that are supplied where a scene has none.
#pragma once

#include <vector>

#include "renderer/scene/scene.hpp"

namespace footprint {

/// A key and a fill directional light and a point light, placed relative to the camera and sized by the bounds so that
/// a white Lambert surface at the bounds' centre that faces the camera has radiance 0.8: 0.5 of it by the key (from the
/// upper left), 0.1 by the fill (from the lower right), 0.2 by the point light (up right, three radii away).
[[nodiscard]] std::vector<Light> supplied_lights(const Camera& camera, const Bounds& bounds);

}  // namespace footprint
