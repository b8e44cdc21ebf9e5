// The lights, and the environment, that are supplied where a scene has none.
#pragma once

#include <vector>

#include "renderer/scene/environment.hpp"
#include "renderer/scene/scene.hpp"

namespace footprint {

/// A key and a fill directional light and a point light, placed relative to the camera and sized by the bounds so that
/// a white Lambert surface at the bounds' centre that faces the camera has radiance 0.8: 0.5 of it by the key (from the
/// upper left), 0.1 by the fill (from the lower right), 0.2 by the point light (up right, three radii away).
[[nodiscard]] std::vector<Light> supplied_lights(const Camera& camera, const Bounds& bounds);

/// Soft light from all around, +y up, for what mirrors and would be black under lamps alone: grey from a dark floor to
/// a bright ceiling, and two wide, neutral lights high at the left and the right. White Lambert has radiance 0.1 to 0.5
/// in it. 256 x 128, smooth: no lobe in it is sharper than 12.
[[nodiscard]] Environment supplied_environment();

}  // namespace footprint
