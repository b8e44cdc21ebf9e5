// A mesh with shorter edges and the same surface, for what is kept at vertices.
#pragma once

#include "renderer/scene/scene.hpp"

namespace footprint {

/// Splits edges at their middle until none is longer than `longest` metres. Vertices in the middle have the mean of
/// their ends' values, normals and tangents as they are (not brought to unit length), so that what a rasteriser
/// interpolates stays what it was. The first vertices are those of `mesh`, in order. Whether an edge is split depends
/// on its ends alone: triangles that met still meet. An infinite `longest` leaves all as it is.
/// Throws std::logic_error where `longest` is not above 0.
[[nodiscard]] Mesh subdivided(const Mesh& mesh, float longest);

}  // namespace footprint
