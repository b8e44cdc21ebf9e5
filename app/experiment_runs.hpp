// Experiments run to their reports, or a part of them to be merged later.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "app/part_file.hpp"
#include "app/requested_experiments.hpp"
#include "experiments/studies/finished_work.hpp"
#include "results/report/records.hpp"

namespace footprint {

/// The folder below a run's output folder in which its finished work is stored.
[[nodiscard]] std::filesystem::path finished_work_folder(const std::filesystem::path& output);

/// A message on the parts of an earlier run that were reused, with the option to measure again.
[[nodiscard]] std::string reuse_text(const FinishedWork& finished);

/// The program and the OpenGL renderer that measure a run with these settings. Errors (machine): no OpenGL.
[[nodiscard]] std::string maker_for(const RunSettings& run);

/// The receivers of results.
struct RunListener {
  std::function<void(const Results& results)> experiment = [](const Results& /*results*/) {};
  std::function<void(const ExperimentReport& report)> matrix = [](const ExperimentReport& /*report*/) {};
};

/// Runs each experiment, except for its finished parts, into `output` or, of members, into folders of their own
/// below it, and prints the tables; of a matrix the one over all members, which is written to its folder too. Errors:
/// those of run_experiment, and (usage) a threshold within the reference's noise; work that is finished by then
/// stays. Of several experiments one that cannot be run is passed over: the error comes at the end, of the first
/// one's kind.
void run_and_print(const RequestedExperiments& requested, const std::filesystem::path& output,
                   const FinishedWork& finished, bool quiet, const RunListener& listener);

/// Measures one part of all experiments together and stores it in `finished`. Images are below `output` until they are
/// stored.
void run_part(const RequestedExperiments& requested, const Shard& shard, const std::filesystem::path& output,
              const FinishedWork& finished, bool quiet);

}  // namespace footprint
