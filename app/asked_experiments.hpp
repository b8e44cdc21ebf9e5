// From what a command line asks for to the experiments that are run, and what tells two such requests apart.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "experiments/runner/experiment.hpp"

namespace footprint {

/// Which experiments, and how.
struct ExperimentRequest {
  std::string experiment;  ///< a name, or a path; a folder stands for all experiments in it
  std::string only;        ///< a regular expression that a member's name must have a match of; empty: all are run
  bool quick = false;
  std::function<void(RunSettings& run)> apply;  ///< what the command line sets over an experiment's own settings
};

/// The file or folder that is named, and the experiments to run: that one, its members, or all in the folder, none of
/// which has members of its own.
struct AskedExperiments {
  std::filesystem::path file;
  std::vector<Experiment> experiments;

  /// Whether each goes into a folder of its own name.
  [[nodiscard]] bool has_members() const { return file != experiments.front().file; }
  /// A hash of all that was asked for: of the files' bytes and of what the command line sets.
  std::string fingerprint;
};

/// Errors (usage): no such experiment; of its files; members that have members; --only is no regular expression, or
/// leaves nothing.
[[nodiscard]] AskedExperiments ask_experiments(const ExperimentRequest& request);

}  // namespace footprint
