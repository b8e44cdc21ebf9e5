// The procedural surfaces that this build holds. CMake writes the list: one line a surface in CMakeLists.txt.
#pragma once

#include <span>

#include "renderer/scene/surface.hpp"

namespace footprint {

/// All surfaces, in the order of scenes/surfaces/CMakeLists.txt.
[[nodiscard]] std::span<const Surface> all_surfaces();

}  // namespace footprint
