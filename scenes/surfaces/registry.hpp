// The procedural surfaces of this build. CMake writes the list from CMakeLists.txt, one line per surface.
#pragma once

#include <span>

#include "renderer/scene/surface.hpp"

namespace footprint {

/// All surfaces, in the order of scenes/surfaces/CMakeLists.txt.
[[nodiscard]] std::span<const Surface> all_surfaces();

}  // namespace footprint
