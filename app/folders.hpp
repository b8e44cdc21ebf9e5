// Where the program finds what has a name: scenes and experiments.
#pragma once

#include <filesystem>

#include "renderer/scene/surface.hpp"

namespace footprint {

/// Where the experiments that have a name lie: the environment variable FOOTPRINT_EXPERIMENTS, else
/// experiments/ of the installed tree, else of the source tree.
[[nodiscard]] std::filesystem::path experiments_folder();

/// Where the scenes that have a name lie (FOOTPRINT_SCENES, else scenes/ of the installed tree, else of the source
/// tree), and the surfaces of this build.
[[nodiscard]] SceneLibrary scene_library();

}  // namespace footprint
