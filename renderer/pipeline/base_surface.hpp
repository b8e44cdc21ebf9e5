// The base BRDF as a method, which the reference averages. It reads only the finest level.
#pragma once

#include "renderer/bake/method.hpp"

namespace footprint {

/// The module of the reference. `direct` evaluates the same, once per pixel.
[[nodiscard]] const Method& base_surface();

}  // namespace footprint
