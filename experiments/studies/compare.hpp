// The main job: methods against the supersampled reference over the distances of a scene, as records and pictures.
#pragma once

#include <filesystem>
#include <span>

#include "experiments/settings/run_settings.hpp"
#include "experiments/studies/frame_times.hpp"
#include "renderer/core/progress.hpp"
#include "results/report/records.hpp"

namespace footprint {

/// Times frames and does nothing else: what each further process of `--processes` runs.
[[nodiscard]] FrameTimes time_frames(const RunSettings& settings, const Progress& progress);

struct SharedTruth;

/// Runs the comparison and writes its pictures into FOLDER/images (made here). `further_times` are those of other
/// processes; the figures are over all of them. Results lacks tool and backend.cpu, which the program knows.
/// What `shared` has of the truth is not rendered again (truth.hpp).
/// Errors: of scene, methods and settings (usage), of the machine, an interrupt through `progress`.
[[nodiscard]] Results run_compare(const RunSettings& settings, const std::filesystem::path& folder,
                                  std::span<const FrameTimes> further_times, const Progress& progress,
                                  SharedTruth* shared = nullptr);

}  // namespace footprint
