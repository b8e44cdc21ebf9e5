// The simplest model: one flat rectangle, for scenes that are a normal map alone and for tests.
#pragma once

#include <glm/glm.hpp>

#include "renderer/scene/scene.hpp"

namespace footprint {

/// A rectangle of `size` (metres) in the xy plane, centred on the origin: normal +z, tangent +x, four vertices, two
/// triangles, material 0. Texture coordinates run from (0, 0) at the top left to `uv_tiling` at the bottom right (glTF:
/// v points down), in both sets.
[[nodiscard]] Mesh make_plane(glm::vec2 size, glm::vec2 uv_tiling);

}  // namespace footprint
