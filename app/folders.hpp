// Where the program finds scenes and experiments by name, and its own data.
#pragma once

#include <filesystem>

#include "renderer/scene/surface.hpp"

namespace footprint {

/// The folder of experiments: the environment variable FOOTPRINT_EXPERIMENTS, else experiments/ of the installed tree,
/// else of the source tree.
[[nodiscard]] std::filesystem::path experiments_folder();

/// The folder of scenes (FOOTPRINT_SCENES, else scenes/ of the installed tree, else of the source tree), and the
/// surfaces of this build.
[[nodiscard]] SceneLibrary scene_library();

/// The model of `recommend --quick`: results/quick_model.json of the installed tree, else of the source tree.
[[nodiscard]] std::filesystem::path quick_model_file();

}  // namespace footprint
