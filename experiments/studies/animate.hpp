// The frames of a path by some methods and by one reference, with error, flicker and highlights frame by frame.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/kept/kept_work.hpp"
#include "experiments/settings/run_settings.hpp"
#include "renderer/core/progress.hpp"
#include "results/report/animation_report.hpp"

namespace footprint {

/// What was measured of an animation: the keys in `kept` of its head and of the frames that were asked for.
struct MeasuredFrames {
  std::string head;
  std::vector<std::string> frames;
};

/// Which of so many frames are measured: from the first to before the second.
using FrameRange = std::function<std::pair<std::size_t, std::size_t>(std::size_t frames)>;

/// Renders the frames that `range` says, holding two at a time, as far as `kept` does not have them, and writes
/// FOLDER/images/reference_NNNN and METHOD_NNNN, .exr and .png. A frame is the same, to the last bit, whichever were
/// rendered before it. Errors: of scene, methods and settings (usage, also of a path without extent), of the machine,
/// an interrupt through `progress`; what is finished until then is kept.
[[nodiscard]] MeasuredFrames measure_animation(const RunSettings& settings, const FrameRange& range,
                                               const std::filesystem::path& folder, const KeptWork& kept,
                                               const Progress& progress);

/// All frames. The result lacks tool and backend.cpu, which the program knows.
[[nodiscard]] Animation run_animation(const RunSettings& settings, const std::filesystem::path& folder,
                                      const KeptWork& kept, const Progress& progress);

}  // namespace footprint
