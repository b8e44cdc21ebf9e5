// Texture coordinates for a mesh that has none: charts cut out of it, laid flat side by side without overlap.
#pragma once

#include "renderer/scene/scene.hpp"

namespace footprint {

/// Gives every triangle its own part of the unit square, in both sets of texture coordinates, all at one scale.
/// A chart is a connected piece whose triangles lean away from its axis by 60 degrees at most (so that lengths
/// shrink to a half at most) and do not overlap seen along it; its upper side is towards +y, or -z where it lies level.
/// Charts are packed with a gap of 1/1024 of the square around each. Vertices on a border between charts are split,
/// tangents computed; positions and normals stay, so do the triangles' order and winding. Triangles without area lie at
/// (0, 0). Positions must be finite.
void unwrap(Mesh& mesh);

}  // namespace footprint
