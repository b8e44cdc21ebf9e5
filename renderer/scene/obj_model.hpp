// A Wavefront OBJ file to a Model: its triangles, with one plain material.
#pragma once

#include <filesystem>

#include "renderer/scene/model.hpp"

namespace footprint {

/// Loads v, vt, vn and f (Wavefront, Advanced Visualizer manual, appendix B1): polygons as fans, indices from 1 or
/// negative from the end. Vertices without a normal get the area-weighted mean of their triangles' normals, and v of
/// `vt`, which points up, is turned downwards as glTF has it. Materials, groups and every other statement are left out.
/// At most 2 GiB and 2^26 triangles. Errors (usage) read "FILE:LINE: ...": a number or an index that is none.
[[nodiscard]] Model load_obj(const std::filesystem::path& file);

}  // namespace footprint
