// Folders by environment variable, else of the tree in which the program is installed, else of the source tree.
#include "app/folders.hpp"

#include <cstdlib>
#include <system_error>

#include "scenes/surfaces/registry.hpp"

namespace footprint {
namespace {

namespace fs = std::filesystem;

// The folder that contains scenes/ and experiments/. A program in PREFIX/bin or PREFIX/libexec finds
// PREFIX/share/footprint, wherever PREFIX was moved to.
fs::path data_folder() {
  std::error_code unknown;
  const fs::path program = fs::read_symlink("/proc/self/exe", unknown);
  fs::path installed = program.parent_path().parent_path() / "share" / "footprint";
  return fs::is_directory(installed / "scenes", unknown) ? installed : fs::path(FOOTPRINT_SOURCE_FOLDER);
}

fs::path folder_of(const char* variable, const char* name) {
  const char* given = std::getenv(variable);
  return given != nullptr && *given != '\0' ? fs::path(given) : data_folder() / name;
}

}  // namespace

fs::path experiments_folder() { return folder_of("FOOTPRINT_EXPERIMENTS", "experiments"); }

SceneLibrary scene_library() { return {.folder = folder_of("FOOTPRINT_SCENES", "scenes"), .surfaces = all_surfaces()}; }

fs::path quick_model_file() { return data_folder() / "results" / "quick_model.json"; }

}  // namespace footprint
