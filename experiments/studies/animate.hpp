// The frames of a path by some methods and by one reference, with error, flicker and highlights frame by frame.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/settings/run_settings.hpp"
#include "experiments/studies/finished_work.hpp"
#include "renderer/core/progress.hpp"
#include "results/report/animation_report.hpp"

namespace footprint {

/// The range of frames to measure, from the first to before the second.
/// frames: of the whole animation.
using FrameRange = std::function<std::pair<std::size_t, std::size_t>(std::size_t frames)>;

/// Renders the frames of a range and writes FOLDER/images/reference_NNNN and METHOD_NNNN, .exr and .png; two frames are
/// in memory at a time. A frame is bit-identical whichever frames were rendered before it.
/// finished: frames that are in here are not rendered, and the others are stored here.
/// Returns the fingerprint under which they are stored. Errors: of scene, methods and settings (usage, also of a path
/// without extent), of the machine, an interrupt through `progress`.
[[nodiscard]] std::string measure_animation(const RunSettings& settings, const FrameRange& range,
                                            const std::filesystem::path& folder, const FinishedWork& finished,
                                            const Progress& progress);

/// The animation of finished frames; its images go to FOLDER/images. It lacks tool and backend.cpu.
/// run: fingerprint of measure_animation.
/// Errors (usage): a frame is missing or damaged.
[[nodiscard]] Animation joined_animation(const FinishedWork& finished, const std::string& run,
                                         const std::filesystem::path& folder);

/// All frames of an animation: measure_animation, then joined_animation.
[[nodiscard]] Animation run_animation(const RunSettings& settings, const std::filesystem::path& folder,
                                      const FinishedWork& finished, const Progress& progress);

}  // namespace footprint
