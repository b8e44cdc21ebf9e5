// Edits of a scene's small-scale geometry: parameters change every frame, and each stage up to the picture is timed.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/studies/parameter_sweep.hpp"
#include "renderer/core/options.hpp"
#include "renderer/gl/context.hpp"
#include "renderer/scene/surface.hpp"
#include "results/report/edit_report.hpp"

namespace footprint {

/// What `footprint edit` is asked for.
struct EditSettings {
  std::string scene;  ///< as load_scene takes it
  SceneLibrary scene_library;
  std::vector<ParameterSweep> sweeps;  ///< one or more
  MethodSpec method;
  int frames = 2;                  ///< 1 or more
  std::optional<glm::ivec2> size;  ///< none: the scene's
  int anisotropy = 1;              ///< probes along the footprint's major axis
  int tile = 0;                    ///< pixels a side drawn at once; 0: as many as fit
  std::optional<float> exposure;   ///< none: the scene's own, else automatic over the first frame
  gl::ContextRequest context;
};

/// Renders frame by frame and writes FOLDER/images/METHOD_NNNN, .exr and .png. Nothing is taken from a cache: a frame's
/// times are those of its own work; the first frame is drawn once before it is timed, as programs are compiled when
/// they are first used. The result lacks tool and backend.cpu, which the program knows. Errors: of scene, sweeps,
/// method and settings (usage; also a scene without generated small-scale geometry), of the machine, an interrupt
/// through `progress`.
[[nodiscard]] EditRun run_edit(const EditSettings& settings, const std::filesystem::path& folder,
                               const Progress& progress);

}  // namespace footprint
