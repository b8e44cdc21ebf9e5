// Light that comes from so small a part of an environment that methods' lookups by lobes lose it.
#pragma once

#include <optional>
#include <string>

#include "renderer/scene/environment.hpp"

namespace footprint {

/// Within this angle of the centre of an environment's brightest texel, radians, 0.34 degrees: the sun's disc, well
/// under the 0.8 degrees that the sharpest map of methods' lookups smears over (radiance_stack.hpp).
inline constexpr double small_sun_angle = 0.006;

/// The share of an environment's light, over all directions and channels, that comes from within `small_sun_angle` of
/// its brightest texel; 0 of a black one, and of one whose texels are larger.
[[nodiscard]] double small_sun_share(const Environment& environment);

/// What a user should know of it; none where the share is under a tenth.
[[nodiscard]] std::optional<std::string> small_sun_warning(const Environment& environment);

}  // namespace footprint
