// The [matrix] of an experiment: values that settings take in turn, and the members that come of them.
#pragma once

#include <string>
#include <vector>

#include "experiments/runner/experiment.hpp"

namespace footprint {

class TomlTable;

/// The keys that a file's [matrix] has. Errors (usage) name file and line: a key that it does not take, or none.
[[nodiscard]] std::vector<std::string> matrix_keys_of(const TomlTable& root);

/// Reads [matrix], where a file has it, into an experiment that has the file's other settings: its axes, the first
/// member's settings, and methods times options. Errors (usage) name file, line and key: values that the setting does
/// not take, one that is there twice, too many members or methods.
void read_matrix(const TomlTable& root, Experiment& experiment);

/// The members, the last axis first to change; each with a name of its own that a folder may have. What is said of all
/// of them together, claims and thresholds, is left to the whole.
[[nodiscard]] std::vector<Experiment> members_of_matrix(const Experiment& whole);

/// Whether a measure includes the member at these coordinates.
[[nodiscard]] bool selects(const Measure& measure, const Coordinates& member);

/// Takes out of `whole` the claims, thresholds and published figures that are over any of the members in `missing`, and
/// gives their names.
std::vector<std::string> leave_out(Experiment& whole, const std::vector<Coordinates>& missing);

}  // namespace footprint
