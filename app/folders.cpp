// Folders by environment variable, or of the source tree.
#include "app/folders.hpp"

#include <cstdlib>

#include "scenes/surfaces/registry.hpp"

namespace footprint {
namespace {

// What the environment names, or the source tree's own.
std::filesystem::path folder_of(const char* variable, const char* otherwise) {
  const char* given = std::getenv(variable);
  return given != nullptr && *given != '\0' ? given : otherwise;
}

}  // namespace

std::filesystem::path experiments_folder() { return folder_of("FOOTPRINT_EXPERIMENTS", FOOTPRINT_EXPERIMENTS_FOLDER); }

SceneLibrary scene_library() {
  return {.folder = folder_of("FOOTPRINT_SCENES", FOOTPRINT_SCENES_FOLDER), .surfaces = all_surfaces()};
}

}  // namespace footprint
