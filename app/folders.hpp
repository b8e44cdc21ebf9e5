// Where the program finds what has a name: scenes and experiments.
#pragma once

#include <filesystem>

#include "renderer/scene/surface.hpp"

namespace footprint {

/// Where the experiments that have a name lie: the environment variable FOOTPRINT_EXPERIMENTS, or the source tree's
/// experiments/.
[[nodiscard]] std::filesystem::path experiments_folder();

/// Where the scenes that have a name lie (the environment variable FOOTPRINT_SCENES, or the source tree's scenes/), and
/// the surfaces of this build.
[[nodiscard]] SceneLibrary scene_library();

}  // namespace footprint
