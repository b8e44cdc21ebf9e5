// The frames of a zoom by some methods and by the reference, with error and flicker frame by frame.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/studies/stage.hpp"
#include "renderer/scene/surface.hpp"
#include "results/report/animation_report.hpp"

namespace footprint {

/// What `footprint animate` is asked for.
struct AnimateSettings {
  std::string scene;  ///< as load_scene takes it
  SceneLibrary scene_library;
  StageSettings stage;         ///< with one method or more
  std::optional<double> from;  ///< factor on the camera's distance; none: the first of the scene's zoom path
  std::optional<double> to;    ///< none: the last of it; 8 times `from` where it has one only
  int frames = 2;              ///< 2 or more
  int spp = 64;                ///< samples a pixel of the reference
  std::uint64_t seed = 1;
  std::optional<float> exposure;  ///< none: the scene's own, else automatic over the first frame
  gl::ContextRequest context;
};

/// Renders frame by frame, holding two at a time, and writes FOLDER/images/reference_NNNN and METHOD_NNNN, .exr and
/// .png. The result lacks tool and backend.cpu, which the program knows. Errors: of scene, methods and settings (usage,
/// also a zoom without extent), of the machine, an interrupt through `progress`.
[[nodiscard]] Animation run_animation(const AnimateSettings& settings, const std::filesystem::path& folder,
                                      const Progress& progress);

}  // namespace footprint
