// The scene that hard pictures are made of: a square under one light.
#pragma once

#include "renderer/scene/scene.hpp"

namespace footprint::stability {

/// Columns and rows of their pictures.
inline constexpr int picture_edge = 24;

/// A square of side 2 in the plane z = 0, of what glTF materials are, seen from above.
[[nodiscard]] Scene square(Image normals, float roughness);

}  // namespace footprint::stability
