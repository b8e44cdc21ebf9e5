// The main job: methods against the supersampled reference over the distances of a scene, as records and pictures.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "experiments/settings/run_settings.hpp"
#include "renderer/core/progress.hpp"
#include "results/report/records.hpp"

namespace footprint {

/// Frame times of one process: [distance][candidate][repeat], milliseconds; candidate 0 is `direct`, then the methods
/// in the order of the settings (whole frames), then the frame builds alone of those that have one, in the same order.
using FrameTimes = std::vector<std::vector<std::vector<double>>>;

/// Times frames and does nothing else: what each further process of `--processes` runs.
[[nodiscard]] FrameTimes time_frames(const RunSettings& settings, const Progress& progress);

/// Runs the comparison and writes its pictures into FOLDER/images (made here). `further_times` are those of other
/// processes; the figures are over all of them. Results lacks tool and backend.cpu, which the program knows.
/// Errors: of scene, methods and settings (usage), of the machine, an interrupt through `progress`.
[[nodiscard]] Results run_compare(const RunSettings& settings, const std::filesystem::path& folder,
                                  std::span<const FrameTimes> further_times, const Progress& progress);

}  // namespace footprint
