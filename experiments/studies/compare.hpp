// The main study: methods against the supersampled reference over the views of a run, as records and images.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "experiments/settings/run_settings.hpp"
#include "experiments/studies/finished_work.hpp"
#include "experiments/studies/frame_times.hpp"
#include "experiments/studies/gpu_cost.hpp"
#include "experiments/studies/reference.hpp"
#include "experiments/studies/stage.hpp"
#include "renderer/core/progress.hpp"
#include "renderer/core/run_folder.hpp"
#include "results/report/records.hpp"

namespace footprint {

/// Times frames and does nothing else: the job of each further process of `--processes`.
[[nodiscard]] FrameTimes time_frames(const RunSettings& settings, const Progress& progress);

/// Returns the times of other processes at all distances; called once, when times are first taken. Empty: there are no
/// other processes.
using FurtherTimes = std::function<std::vector<FrameTimes>()>;

/// Sees the records of one view before its times are taken, one per method: first only with the noise that the
/// reference adds to their errors, before any method is rendered, then with their errors. An exception ends the run.
using RecordWatch = std::function<void(std::span<const Record> records)>;

/// Sees the results over the finished distances, whose images are written, after each distance but the last.
using ResultsWatch = std::function<void(const Results& results)>;

/// The work that comparisons of one scene, view and reference share, for any methods and footprint filters. Comparisons
/// of another size or reference can share only the scene.
struct SharedWork {
  std::shared_ptr<PreparedScene> scene;
  std::string content;  ///< scene_content, taken before the scene was prepared
  SharedReferences references = {};
  std::string first = {};  ///< fingerprint of the first comparison, on whose methods the references depend
};

/// The context of a comparison besides its settings. Everything is optional.
struct CompareContext {
  FurtherTimes further_times = {};
  const FinishedWork* finished = nullptr;  ///< parts are taken from here and stored here
  SharedWork* shared = nullptr;
  RecordWatch watch = {};
  ResultsWatch so_far = {};
  GpuCompiler gpu_compiler = {};  ///< if the settings have GPUs
};

/// Runs the comparison or the animation and writes its images into FOLDER/images (created). An image that cannot be
/// written is a loss of the folder. If all parts are finished, no OpenGL context is created. The results lack tool and
/// backend.cpu, which the program knows. Errors: of scene, methods and settings (usage), of the machine, an interrupt
/// through `progress`.
[[nodiscard]] Results run_compare(const RunSettings& settings, const RunFolder& folder, const Progress& progress,
                                  const CompareContext& context);

/// Measures some views of the run, by their index, and stores them in `context.finished`.
/// folder: for images until they are stored.
/// Returns the fingerprint under which they are stored.
std::string measure_views(const RunSettings& settings, std::span<const std::size_t> views, const RunFolder& folder,
                          const Progress& progress, const CompareContext& context);

}  // namespace footprint
