// The [region] of an experiment: settings that its paper leaves open, over which its claims are judged one by one.
#pragma once

#include <span>
#include <vector>

#include "experiments/runner/experiment.hpp"
#include "results/report/region_report.hpp"

namespace footprint {

class TomlTable;

/// Reads [region], where a file has it, into an experiment that has the file's other settings and claims. Errors
/// (usage) name file, line and key: values that a setting does not take, one that is there twice, too many settings, a
/// file without claims or with a [matrix].
void read_region(const TomlTable& root, Experiment& experiment);

/// The experiment as its file states it, and then one for each combination of the region's values, the last axis first
/// to change. Each has the claims, over its own methods and distances, and measures no more than they ask for. Errors
/// (usage): the file has no [region]; of its scene.
[[nodiscard]] std::vector<Experiment> settings_of_region(const Experiment& stated);

/// The outcome of each claim. `runs` has the results of the stated setting and of all others, in the order of
/// settings_of_region.
[[nodiscard]] RegionReport region_report(const Experiment& stated, std::span<const Results> runs);

}  // namespace footprint
