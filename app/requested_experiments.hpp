// The experiments that a command line requests, and a fingerprint that distinguishes requests.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "experiments/runner/experiment.hpp"

namespace footprint {

/// Which experiments, and how.
struct ExperimentRequest {
  std::string experiment;  ///< a name, or a path; a folder means all experiments in it
  std::string only;        ///< a regular expression that the names of members must match; empty: all are run
  bool quick = false;
  std::function<void(RunSettings& run)> apply;  ///< the command line's settings over an experiment's own
};

/// A matrix whose members are run, and the claims and figures over all of them.
struct RequestedMatrix {
  Experiment whole;
  std::size_t first = 0, count = 0;   ///< its members, in the list of experiments
  std::vector<std::string> left_out;  ///< claims and figures over members that --only leaves out: they are not judged
};

/// The file or folder that is named, and the experiments to run: that one, its members, or all in the folder. None of
/// them has members of its own.
struct RequestedExperiments {
  std::filesystem::path file;
  std::vector<Experiment> experiments;
  std::vector<RequestedMatrix> matrices;

  /// Whether each goes into a folder of its own name.
  [[nodiscard]] bool has_members() const { return !matrices.empty() || file != experiments.front().file; }
  /// The folder of a matrix' report below the output folder; empty for the one that is named.
  [[nodiscard]] std::filesystem::path folder_of(const RequestedMatrix& matrix) const;
  /// The same of an experiment's report.
  [[nodiscard]] std::filesystem::path folder_of(const Experiment& experiment) const;
  /// A hash of the request: of the files' bytes and of the settings of the command line.
  std::string fingerprint;
};

/// Errors (usage): no such experiment; of its files; members that have members; --only is not a regular expression, or
/// leaves nothing.
[[nodiscard]] RequestedExperiments requested_experiments(const ExperimentRequest& request);

}  // namespace footprint
