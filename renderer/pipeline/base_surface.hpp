// The base BRDF as a method: what the reference averages. It reads the finest level alone.
#pragma once

#include "renderer/bake/method.hpp"

namespace footprint {

/// The module of the reference. `direct` shades the same, once a pixel.
[[nodiscard]] const Method& base_surface();

}  // namespace footprint
