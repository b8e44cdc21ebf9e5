// Arithmetic over the figures of a run, and the inequalities that claims are made of; the functions that they call, in
// one table for the parser, the check of an experiment and the evaluation (docs/reference/experiments.md).
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "results/report/records.hpp"

namespace footprint {

struct Experiment;
struct FigureFunction;

/// A selector of a call: `distance=4`, in the order in which calls are written.
enum class Selector {
  distance,
  frame,
  filter,  ///< the footprint filter; this and the next three: of members of a matrix those with the value on that axis
  scene,
  seed,
  size,
  footprint,  ///< of an effective NDF: its name in the experiment
  name,       ///< of a quantity in the experiment
  gpu,        ///< of an estimated cost; not given: the experiment's only one
  spp         ///< above 0; of the reference, or of plain supersampling
};

/// The words for the selectors, in the order of Selector.
inline constexpr std::array<std::string_view, 10> selector_names{"distance", "frame",     "footprint", "scene", "seed",
                                                                 "size",     "footprint", "name",      "gpu",   "spp"};

/// The selectors of the axes of a matrix.
inline constexpr std::array<Selector, 4> axis_selectors{Selector::filter, Selector::scene, Selector::seed,
                                                        Selector::size};

[[nodiscard]] constexpr std::string_view selector_name(Selector selector) {
  return selector_names.at(static_cast<std::size_t>(selector));
}

/// One call of an expression: a figure of one method, the mean over the records that the selectors leave.
struct Measure {
  const FigureFunction* function = nullptr;  ///< a row of figure_functions(); null in no call
  std::string method;  ///< a method as the experiment writes it, its name alone where only one has it, or `*`
  std::map<Selector, std::string> selected{};  ///< values as they are written, numbers shortest

  /// The value of a selector; null: it is not given.
  [[nodiscard]] const std::string* word(Selector selector) const;
  [[nodiscard]] std::optional<double> number(Selector selector) const;
  /// Whether a selector has the value, or is not given.
  [[nodiscard]] bool takes(Selector selector, const std::string& value) const;
  [[nodiscard]] bool takes(Selector selector, double value) const;
};

/// "error(toksvig:storage=fp16, distance=4)".
[[nodiscard]] std::string measure_text(const Measure& measure);

/// The index in `methods` of the one that is written `wanted`, else of the only one with that name. Errors (usage,
/// no place): none, with the nearest; more than one.
[[nodiscard]] std::size_t select_method(const std::string& wanted, std::span<const std::string> methods);

/// The value of a measure over a run.
struct Measured {
  std::string text;  ///< of the measure
  std::optional<double> value;
  std::string problem;                ///< why there is none
  bool at_noise_floor = false;        ///< an error that the reference's own noise explains, in every record that counts
  std::optional<double> noise_floor;  ///< of an error: what the reference's own noise causes of it, where known
  std::set<std::string> nodes;        ///< of a time: the machines that it was taken on
  std::size_t records = 0;            ///< that the value is the mean of
};

/// An expression's value, or why it has none, and the figures that it was made of, each once.
struct Evaluation {
  std::optional<double> value;
  std::string problem;
  std::vector<Measured> calls;
  std::set<std::string> nodes{};  ///< the machines that times in it were taken on; of several there is a problem
};

/// `2 * error(toksvig, distance=4) - 0.01`: numbers, calls, `abs(...)`, + - * /, unary minus, parentheses.
struct Expression {
  enum class Kind { number, call, negate, absolute, binary };
  Kind kind = Kind::number;
  double number = 0;
  Measure measure{};                ///< of a call
  char operation = '+';             ///< of a binary: + - * /
  std::vector<Expression> parts{};  ///< operands

  Expression() = default;
  /// Errors (usage): `place` and the column (from 1) of what does not fit, with the nearest right function.
  Expression(const std::string& text, const std::string& place);

  /// The calls from left to right.
  [[nodiscard]] std::vector<Measure> measures() const;
  /// Calls `change` with every call's measure, from left to right.
  void for_each_measure(const std::function<void(Measure&)>& change);
  /// Returns the expression with `method` wherever the method is `*`.
  [[nodiscard]] Expression with_method(const std::string& method) const;
  /// The expression as it would be written, in one style.
  [[nodiscard]] std::string text() const;
  /// Evaluates over one run, or the members of a matrix. Its methods must be the runs' (select_method). A division by 0
  /// or a figure that was not measured is a problem.
  [[nodiscard]] Evaluation evaluate(std::span<const Results> runs) const;
};

/// `error(tan_gmm) < 0.5 * error(toksvig)`: two expressions with one of < <= > >= between them.
struct Inequality {
  Expression left;
  std::string relation;
  Expression right;

  /// Errors (usage) as those of Expression.
  Inequality(const std::string& text, const std::string& place);

  [[nodiscard]] bool is_true(double left_value, double right_value) const;
  /// Calls `change` with every call's measure of both sides.
  void for_each_measure(const std::function<void(Measure&)>& change);
};

/// Why times of these machines are not comparable; empty for one machine. Across machines only `ratio` is comparable,
/// because each ratio is formed on one machine.
[[nodiscard]] std::string mixed_hosts_message(const std::set<std::string>& nodes);

/// The figure of one record, or of another thing that a run measured.
struct Sample {
  std::optional<double> value{};
  std::string absent{};  ///< why there is none, if the record says so
  bool at_noise_floor = false;
  std::optional<double> noise_floor{};  ///< of an error
  std::string node{};                   ///< of a time
};

/// A function of a method's figures.
struct FigureFunction {
  std::string_view name;
  std::vector<Selector> selectors;
  /// Refuses (usage) a call that a run of the experiment would have no figure for.
  void (*needs)(const Measure& measure, const Experiment& experiment);
  /// The figures of `method`, as the run writes it, that the measure is the mean of.
  std::function<std::vector<Sample>(const Measure& measure, const std::string& method, const Results& run)> samples;
  std::string_view absent = "no record has this figure";  ///< the problem if no record has it
  std::string_view none = "the run has no such record";   ///< the problem if there is no sample
  std::string_view alias = name;                          ///< another name that expressions may use
  std::size_t first_frame = 0;                            ///< frames before it have no figure
};

/// All functions, in the order of the documentation.
[[nodiscard]] std::span<const FigureFunction> figure_functions();

/// Refuses (usage, with the measure as the place) what a run of the experiment would have no figure for: known before
/// it starts.
void check_measure(const Measure& measure, const Experiment& experiment);

/// Refuses (usage) a distance or frame that an experiment over these distances and of so many frames has no figure for.
void check_distance(const Measure& measure, const std::vector<double>& distances, std::size_t frames);

/// The mean over the records of the method that match, in one run or in the members of a matrix; those without the
/// figure do not count. `measure.method` must be one of the runs'.
[[nodiscard]] Measured measured(const Measure& measure, std::span<const Results> runs);

}  // namespace footprint
