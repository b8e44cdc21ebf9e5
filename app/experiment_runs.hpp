// The experiments that a command line requests, and their runs to reports or to parts that are merged later.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/part_file.hpp"
#include "experiments/runner/experiment.hpp"
#include "experiments/studies/finished_work.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/files.hpp"
#include "renderer/gl/context.hpp"
#include "results/report/records.hpp"

namespace footprint {

/// The experiments to run, and how.
struct ExperimentRequest {
  std::string experiment;  ///< a name, or a path; a folder means all experiments in it
  std::string only;        ///< a regular expression that the names of members must match; empty: all are run
  bool quick = false;
  bool region = false;                          ///< at every setting of its [region] too
  std::function<void(RunSettings& run)> apply;  ///< the command line's settings over an experiment's own
};

/// Experiments that are judged together: the members of a matrix that are run, the settings of a region, or one alone.
struct ExperimentGroup {
  std::vector<Experiment> experiments;
  std::optional<Experiment> matrix = {};   ///< of which they are members
  std::optional<Experiment> region = {};   ///< of which they are the stated setting and all others
  std::vector<std::string> left_out = {};  ///< what the matrix says of members that --only leaves out: it is not judged

  [[nodiscard]] const Experiment& judged() const { return matrix ? *matrix : experiments.front(); }
};

/// The file or folder that is named, and the experiments to run: that one, its members, or all in the folder. None of
/// them has members of its own.
struct RequestedExperiments {
  std::filesystem::path file;
  std::vector<ExperimentGroup> groups;
  std::string fingerprint;  ///< of the files' bytes and of the settings of the command line

  [[nodiscard]] const Experiment& first() const { return groups.front().experiments.front(); }
  /// The folder of the report of an experiment or a matrix below the output folder; empty for the only one.
  [[nodiscard]] std::filesystem::path folder_of(const Experiment& experiment) const;
};

/// Errors (usage): no such experiment; of its files; members that have members; --only is not a regular expression, or
/// leaves nothing; a region of an experiment that has none.
[[nodiscard]] RequestedExperiments requested_experiments(const ExperimentRequest& request);

/// The folder below a run's output folder in which its finished work is stored.
[[nodiscard]] std::filesystem::path finished_work_folder(const std::filesystem::path& output);

/// Unless `quiet`, a message on the parts of an earlier run that were reused, with the option to measure again.
void write_reuse(const FinishedWork& finished, bool quiet);

/// The finished work of a run below its output folder.
/// context: of the run, because work of another renderer is not reused.
/// fresh: discards the work of earlier runs. Errors (machine): no OpenGL.
[[nodiscard]] FinishedWork finished_work_in(const std::filesystem::path& output, const gl::ContextRequest& context,
                                            bool fresh);

/// The receivers of results.
struct RunListener {
  std::function<void(const Results& results)> experiment = [](const Results& /*results*/) {};
  std::function<void(const ExperimentReport& report)> matrix = [](const ExperimentReport& /*report*/) {};
};

/// Runs each experiment, except for its finished parts, into `output` or, of members, into folders of their own
/// below it, and prints the tables; of a matrix the one over all members, which is written to its folder too. Errors:
/// those of run_experiment, and (usage) a threshold within the reference's noise; work that is finished by then
/// stays. Of several experiments one that cannot be run is passed over: the error comes at the end, of the first
/// one's kind. Returns the error of the first run in which rows failed.
[[nodiscard]] std::optional<Error> run_and_print(const RequestedExperiments& requested,
                                                 const std::filesystem::path& output, const FinishedWork& finished,
                                                 bool quiet, const RunListener& listener);

/// Makes part `shard` of a run and prints its folder. `measure` does the work and returns what it is a part of.
/// part.json says that the part is whole, and is there only then.
void make_part(const Shard& shard, const std::filesystem::path& output, const FinishedWork& finished,
               const std::function<PartFile()>& measure);

/// Errors (machine): something of a part could not be stored, without which it cannot be merged.
void require_stored(const OutputFolder& scratch);

/// Measures one part of all experiments together and stores it in `finished`. Images are below `output` until they are
/// stored.
void run_part(const RequestedExperiments& requested, const Shard& shard, const std::filesystem::path& output,
              const FinishedWork& finished, bool quiet);

}  // namespace footprint
