// The frames of a zoom by some methods and by the reference, with error and flicker frame by frame.
#pragma once

#include <filesystem>

#include "experiments/settings/run_settings.hpp"
#include "renderer/core/progress.hpp"
#include "results/report/animation_report.hpp"

namespace footprint {

/// Renders the zoom that is asked for frame by frame, holding two at a time, and writes FOLDER/images/reference_NNNN
/// and METHOD_NNNN, .exr and .png. The result lacks tool and backend.cpu, which the program knows. Errors: of scene,
/// methods and settings (usage, also a zoom without extent), of the machine, an interrupt through `progress`.
[[nodiscard]] Animation run_animation(const RunSettings& settings, const std::filesystem::path& folder,
                                      const Progress& progress);

}  // namespace footprint
