// Arithmetic over the figures of a run, and the inequalities that claims are made of (docs/reference/experiments.md).
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "results/report/records.hpp"

namespace footprint {

struct FigureFunction;

/// One call of an expression: a figure of one method, the mean over the records that the selectors leave.
struct Measure {
  const FigureFunction* function = nullptr;  ///< a row of figure_functions() (functions.hpp); null in no call
  std::string method;  ///< a method as the experiment writes it, its name alone where only one has it, or `*`
  std::optional<double> distance;
  std::optional<int> frame;
  std::optional<int> spp;                      ///< above 0; of the reference, or of plain supersampling
  std::map<std::string, std::string> slice{};  ///< of a matrix: by an axis' key the value that members must have
  std::optional<std::string> footprint;        ///< of an NDF: its name in the experiment
  std::optional<std::string> name;             ///< of a quantity in the experiment
  std::optional<std::string> gpu;              ///< of an estimated cost; none: the experiment's only one
};

/// "error(toksvig:storage=fp16, distance=4)".
[[nodiscard]] std::string measure_text(const Measure& measure);

/// The index in `methods` of the one that is written `wanted`, else of the only one with that name. Errors (usage,
/// no place): none, with the nearest; more than one.
[[nodiscard]] std::size_t select_method(const std::string& wanted, std::span<const std::string> methods);

/// A call with what the run said to it.
struct MeasuredCall {
  std::string text;
  double value = 0;
  bool at_noise_floor = false;
  std::optional<double> noise_floor{};  ///< of an error, where it is known
  std::size_t records = 0;              ///< that the value is the mean of
};

/// An expression's value, or why it has none, and the figures that it was made of.
struct Evaluation {
  std::optional<double> value;
  std::string problem;
  std::vector<MeasuredCall> calls;
  std::set<std::string> nodes{};  ///< the machines that times in it were taken on; of several there is a problem
};

/// `2 * error(toksvig, distance=4) - 0.01`: numbers, calls, `abs(...)`, + - * /, unary minus, parentheses.
class Expression {
 public:
  struct Node;

  /// Errors (usage): `place` and the column (from 1) of what does not fit, with the nearest right function.
  Expression(const std::string& text, const std::string& place);
  explicit Expression(const Node& root);
  Expression(const Expression&);
  Expression(Expression&&) noexcept;
  Expression& operator=(const Expression&) = delete;
  Expression& operator=(Expression&&) = delete;
  ~Expression();

  /// The calls from left to right.
  [[nodiscard]] std::vector<Measure> measures() const;
  /// The same expression with `method` wherever the method is `*`.
  [[nodiscard]] Expression with_method(const std::string& method) const;
  /// As it would be written, in one style.
  [[nodiscard]] std::string text() const;
  /// Over one run, or the members of a matrix. Its methods must be the runs' (select_method). A division by 0 or a
  /// figure that was not measured is a problem.
  [[nodiscard]] Evaluation evaluate(std::span<const Results> runs) const;

 private:
  std::vector<Node> root_;  // exactly one: Node is not complete here
};

/// `error(tan_gmm) < 0.5 * error(toksvig)`: two expressions with one of < <= > >= between them.
class Inequality {
 public:
  /// Errors (usage) as those of Expression.
  Inequality(const std::string& text, const std::string& place);

  [[nodiscard]] const std::string& text() const { return text_; }
  [[nodiscard]] const Expression& left() const { return left_; }
  [[nodiscard]] const Expression& right() const { return right_; }
  [[nodiscard]] bool is_true(double left, double right) const;

 private:
  struct Parts;
  Inequality(std::string text, Parts parts);

  std::string text_, relation_;
  Expression left_, right_;
};

}  // namespace footprint
