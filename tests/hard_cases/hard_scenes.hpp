// The scene of the hard cases of images: a square under one light.
#pragma once

#include "renderer/scene/scene.hpp"

namespace footprint::hard_cases {

/// Columns and rows of their images.
inline constexpr int picture_edge = 24;

/// A square of side 2 in the plane z = 0 with a glTF material, seen from above.
[[nodiscard]] Scene square(Image normals, float roughness);

}  // namespace footprint::hard_cases
