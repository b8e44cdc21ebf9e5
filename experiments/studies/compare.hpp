// The main job: methods against the supersampled reference over the distances of a scene, as records and pictures.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "experiments/kept/kept_work.hpp"
#include "experiments/settings/run_settings.hpp"
#include "experiments/studies/frame_times.hpp"
#include "experiments/studies/stage.hpp"
#include "experiments/studies/truth.hpp"
#include "renderer/core/progress.hpp"
#include "results/report/records.hpp"

namespace footprint {

/// Times frames and does nothing else: what each further process of `--processes` runs.
[[nodiscard]] FrameTimes time_frames(const RunSettings& settings, const Progress& progress);

/// Gives the times of other processes, at all distances; called once, where times are taken at all. Empty: there are
/// none.
using FurtherTimes = std::function<std::vector<FrameTimes>()>;

/// Sees the records of one distance before its times are taken, one a method: first with nothing but what the
/// reference's noise causes of their errors, before any method is drawn, then with their errors. What it throws ends
/// the run.
using RecordWatch = std::function<void(std::span<const Record> records)>;

/// Sees the results over the distances that are done, whose images are written, after each distance but the last.
using ResultsWatch = std::function<void(const Results& results)>;

/// What comparisons of one scene, view and reference have in common, whatever their methods and footprint filters.
/// Those of another size or reference can share the scene alone.
struct SharedWork {
  std::shared_ptr<PreparedScene> scene;
  std::string content;  ///< scene_content of it, before it was prepared; of comparisons that keep work
  SharedTruth truth;
  std::string kept_as;  ///< what the truth depends on, said by the first comparison that keeps work
};

/// Runs the comparison and writes its pictures into FOLDER/images (made here). The figures are over this process and
/// `further_times`. Results lacks tool and backend.cpu, which the program knows.
/// What `shared` has is not prepared or rendered again. What `kept` has is not done again, and what is
/// done is kept there, part by part: where all of it is there, no OpenGL is asked for. Errors: of scene, methods and
/// settings (usage), of the machine, an interrupt through `progress`.
[[nodiscard]] Results run_compare(const RunSettings& settings, const std::filesystem::path& folder,
                                  const FurtherTimes& further_times, const Progress& progress,
                                  SharedWork* shared = nullptr, const KeptWork* kept = nullptr,
                                  const RecordWatch& watch = {}, const ResultsWatch& so_far = {});

/// Of the comparison only what belongs to some of its distances, by their index, into `kept`; FOLDER is for pictures on
/// their way. In a zoom, the frame before each must be among them or kept.
void measure_distances(const RunSettings& settings, std::span<const std::size_t> distances,
                       const std::filesystem::path& folder, const FurtherTimes& further_times, const KeptWork& kept,
                       const Progress& progress, const RecordWatch& watch = {});

}  // namespace footprint
