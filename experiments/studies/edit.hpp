// Edits of a scene's small-scale geometry: parameters change every frame, and each stage up to the picture is timed.
#pragma once

#include <filesystem>
#include <vector>

#include "experiments/settings/run_settings.hpp"
#include "experiments/studies/parameter_sweep.hpp"
#include "renderer/core/progress.hpp"
#include "results/report/edit_report.hpp"

namespace footprint {

/// The settings of `footprint edit`.
struct EditSettings {
  RunSettings run;                     ///< with one method; ignores reference, timing and cache
  std::vector<ParameterSweep> sweeps;  ///< one or more
  int frames = 10;                     ///< 1 or more
};

/// Renders frame by frame and writes FOLDER/images/METHOD_NNNN, .exr and .png. Nothing is taken from a cache: a frame's
/// times are those of its own work; the first frame is drawn once before it is timed, as programs are compiled when
/// they are first used. The result lacks tool and backend.cpu, which the program knows. Errors: of scene, sweeps,
/// method and settings (usage; also a scene without generated small-scale geometry), of the machine, an interrupt
/// through `progress`.
[[nodiscard]] EditRun run_edit(const EditSettings& settings, const std::filesystem::path& folder,
                               const Progress& progress);

}  // namespace footprint
