// From what a command line asks for to the experiments that are run, and what tells two such requests apart.
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
  std::string experiment;  ///< a name, or a path; a folder stands for all experiments in it
  std::string only;        ///< a regular expression that a member's name must have a match of; empty: all are run
  bool quick = false;
  std::function<void(RunSettings& run)> apply;  ///< what the command line sets over an experiment's own settings
};

/// A matrix whose members are run, with what is said of all of them together.
struct AskedMatrix {
  Experiment whole;
  std::size_t first = 0, count = 0;   ///< its members, in the list of experiments
  std::vector<std::string> left_out;  ///< what is over members that --only leaves out: it is not judged
};

/// The file or folder that is named, and the experiments to run: that one, its members, or all in the folder, none of
/// which has members of its own.
struct AskedExperiments {
  std::filesystem::path file;
  std::vector<Experiment> experiments;
  std::vector<AskedMatrix> matrices;

  /// Whether each goes into a folder of its own name.
  [[nodiscard]] bool has_members() const { return !matrices.empty() || file != experiments.front().file; }
  /// The folder of a matrix' report, from the output folder: of the one that is named it is that.
  [[nodiscard]] std::filesystem::path folder_of(const AskedMatrix& matrix) const;
  /// The folder of an experiment's.
  [[nodiscard]] std::filesystem::path folder_of(const Experiment& experiment) const;
  /// A hash of all that was asked for: of the files' bytes and of what the command line sets.
  std::string fingerprint;
};

/// Errors (usage): no such experiment; of its files; members that have members; --only is no regular expression, or
/// leaves nothing.
[[nodiscard]] AskedExperiments ask_experiments(const ExperimentRequest& request);

}  // namespace footprint
