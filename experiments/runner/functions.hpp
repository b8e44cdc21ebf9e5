// The functions that claims, thresholds and published figures call: one table for the parser, the check of an
// experiment and the evaluation. A test compares it with the list in docs/reference/experiments.md.
#pragma once

#include <functional>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/runner/expression.hpp"
#include "results/report/records.hpp"

namespace footprint {

struct Experiment;

/// A selector of a call: `distance=4`.
enum class Selector {
  distance,
  frame,
  spp,
  scene,  ///< this and the next four: of the members of a matrix those that have the value on that axis
  size,
  filter,  ///< written "footprint": the footprint filter
  seed,
  footprint,  ///< of an effective NDF
  name,
  gpu  ///< of an estimated cost
};

/// As it is written: "distance".
[[nodiscard]] std::string_view selector_name(Selector selector);

/// The value of a measure over a run.
struct Measured {
  std::optional<double> value;
  std::string problem;          ///< why there is none
  bool at_noise_floor = false;  ///< an error that the reference's own noise explains, in every record that counts
  std::optional<double>
      noise_floor{};              ///< of an error: what the reference's own noise causes of it, where that is known
  std::set<std::string> nodes{};  ///< of a time: the machines that it was taken on
  std::size_t records = 0;        ///< that the value is the mean of
};

/// Why times of these machines are not comparable; empty for one machine. Across machines only `ratio` is comparable,
/// because each ratio is formed on one machine.
[[nodiscard]] std::string mixed_hosts_message(const std::set<std::string>& nodes);

/// A function of a method's figures: a row of the table.
struct FigureFunction {
  std::string_view name;
  std::vector<Selector> selectors;
  /// Refuses (usage) a call that a run of the experiment would have no figure for.
  void (*needs)(const Measure& measure, const Experiment& experiment);
  /// Over the records of `method`, which is one of the runs' as it is written.
  std::function<Measured(const Measure& measure, const std::string& method, std::span<const Results> runs)> evaluate;
};

/// The table, in the order of the documentation.
[[nodiscard]] std::span<const FigureFunction> figure_functions();

/// Refuses (usage, with the measure as the place) what a run of the experiment would have no figure for: known before
/// it starts.
void check_measure(const Measure& measure, const Experiment& experiment);

/// The same of its distance and frame alone, in an experiment over these distances and of so many frames.
void check_distance(const Measure& measure, const std::vector<double>& distances, std::size_t frames);

/// The mean over the records of the method that match, in one run or in the members of a matrix; those without the
/// figure do not count. `measure.method` must be one of the runs'.
[[nodiscard]] Measured measured(const Measure& measure, std::span<const Results> runs);

}  // namespace footprint
