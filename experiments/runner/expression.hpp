// Arithmetic over the figures of a run, and the inequalities that claims are made of (docs/reference/experiments.md).
#pragma once

#include <cstddef>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "experiments/runner/measure.hpp"
#include "results/report/records.hpp"

namespace footprint {

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
