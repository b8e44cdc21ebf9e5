// Which method to take for each material of a scene: candidates compared coarsely, then those in full that could be
// chosen.
#pragma once

#include <functional>
#include <vector>

#include "experiments/settings/run_settings.hpp"
#include "experiments/studies/finished_work.hpp"
#include "renderer/core/progress.hpp"
#include "renderer/core/run_folder.hpp"
#include "renderer/gpu_cost/compiled_programs.hpp"
#include "results/report/recommendation.hpp"

namespace footprint {

/// The settings of `footprint recommend`.
struct RecommendSettings {
  RunSettings run;                       ///< its methods are the candidates; ignores its own footprint filter
  std::vector<FootprintFilter> filters;  ///< under each of which every method is a candidate
  Limits limits;
  bool exhaustive = false;        ///< measure every candidate in full
  GpuCompiler gpu_compiler = {};  ///< if the limit is of a GPU
};

/// The trust in the coarse run's errors and costs: a candidate that is worse by more than this in both is dropped.
inline constexpr double coarse_error_share = 0.15, coarse_cost_share = 0.25;

/// Receives results while it runs.
struct RecommendListener {
  /// Writes the report of a full run into its folder.
  std::function<void(Results& results, const RunFolder& folder)> results;
  /// Receives the answer of the coarse pass, before the full one.
  std::function<void(const Recommendation& answer)> first_answer = [](const Recommendation& /*answer*/) {};
};

/// Compares them. The full runs' pictures and reports go to FOLDER/FILTER, one for each footprint filter that is still
/// in question.
/// finished: parts that are in here are not measured, and the others are stored here. Errors: those of run_compare.
[[nodiscard]] Recommendation run_recommend(const RecommendSettings& settings, const RunFolder& folder,
                                           const FinishedWork& finished, const RecommendListener& listener,
                                           const Progress& progress);

}  // namespace footprint
