// Parses expressions by recursive descent into a tree, and evaluates it.
#include "experiments/runner/expression.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>

#include "renderer/core/error.hpp"
#include "renderer/core/names.hpp"
#include "renderer/core/numbers.hpp"

namespace footprint {

const std::string* Measure::word(Selector selector) const {
  const auto found = selected.find(selector);
  return found == selected.end() ? nullptr : &found->second;
}

std::optional<double> Measure::number(Selector selector) const {
  const std::string* const value = word(selector);
  return value == nullptr ? std::nullopt : parse_whole_of<double>(*value);
}

bool Measure::takes(Selector selector, const std::string& value) const {
  return word(selector) == nullptr || *word(selector) == value;
}

bool Measure::takes(Selector selector, double value) const { return number(selector).value_or(value) == value; }

std::string measure_text(const Measure& measure) {
  std::string text = fmt::format("{}({}", measure.function->name, measure.method);
  for (const auto& [selector, value] : measure.selected) text += fmt::format(", {}={}", selector_name(selector), value);
  return text + ")";
}

std::size_t select_method(const std::string& wanted, std::span<const std::string> methods) {
  std::vector<std::size_t> of_name;
  std::vector<std::string> known(methods.begin(), methods.end());
  for (std::size_t i = 0; i < methods.size(); ++i) {
    if (methods[i] == wanted) return i;
    const std::string name = methods[i].substr(0, methods[i].find(':'));
    if (name == wanted) of_name.push_back(i);
    if (std::ranges::find(known, name) == known.end()) known.push_back(name);
  }
  if (of_name.size() == 1) return of_name.front();
  if (of_name.empty()) {
    throw Error(ErrorKind::usage, "", fmt::format("the experiment has no method `{:.80}`", wanted),
                suggestion(wanted, known));
  }
  throw Error(ErrorKind::usage, "", fmt::format("`{}` is {} of the experiment's methods", wanted, of_name.size()),
              "write it with its options, as in the experiment");
}

namespace {

using Kind = Expression::Kind;

constexpr std::size_t longest_text = 4096;
constexpr int deepest_nesting = 100;
constexpr std::array<std::string_view, 4> relations{"<=", ">=", "<", ">"};

class Parser {
 public:
  Parser(std::string_view text, std::string place) : text_(text), place_(std::move(place)) {
    if (text.size() > longest_text) fail("is longer than 4096 characters", "shorten it");
  }

  Expression sum() {
    Expression left = product();
    while (const char operation = take_one_of("+-")) left = binary(operation, std::move(left), product());
    return left;
  }

  std::string relation() {
    skip_blanks();
    for (const std::string_view candidate : relations) {
      if (!text_.substr(at_).starts_with(candidate)) continue;
      at_ += candidate.size();
      return std::string(candidate);
    }
    fail("one of < <= > >= is missing", "write an inequality such as error(a) < error(b)");
  }

  void end() {
    skip_blanks();
    if (at_ < text_.size()) fail(fmt::format("`{}` does not belong here", text_[at_]), "remove it, or add an operator");
  }

 private:
  Expression product() {
    Expression left = unary();
    while (const char operation = take_one_of("*/")) left = binary(operation, std::move(left), unary());
    return left;
  }

  Expression unary() {
    if (++depth_ > deepest_nesting) fail("is nested too deeply", "simplify it");
    Expression node;
    if (take_one_of("-") != 0) {
      node.kind = Kind::negate;
      node.parts.push_back(unary());
    } else {
      node = primary();
    }
    --depth_;
    return node;
  }

  Expression primary() {
    skip_blanks();
    if (take_one_of("(") != 0) {
      Expression inner = sum();
      expect(')');
      return inner;
    }
    if (at_ < text_.size() && is_letter(text_[at_])) return call();
    return number();
  }

  Expression number() {
    Expression node;
    const char* const first = text_.data() + at_;
    const auto parsed = std::from_chars(first, text_.data() + text_.size(), node.number);
    if (parsed.ec != std::errc() || !std::isfinite(node.number)) {
      fail("a number, a call or a parenthesis is missing", "write an expression such as 0.5 * error(toksvig)");
    }
    at_ += static_cast<std::size_t>(parsed.ptr - first);
    return node;
  }

  Expression call() {
    const std::size_t start = at_;
    while (at_ < text_.size() && (is_letter(text_[at_]) || is_digit(text_[at_]))) ++at_;
    const std::string name(text_.substr(start, at_ - start));
    Expression node;
    if (name == "abs") {
      expect('(');
      node.kind = Kind::absolute;
      node.parts.push_back(sum());
      expect(')');
      return node;
    }
    node.kind = Kind::call;
    node.measure.function = &function(name, start);
    expect('(');
    node.measure.method = argument("a method");
    while (take_one_of(",") != 0) selector(node.measure);
    expect(')');
    return node;
  }

  // The function with that name or alias, which starts at `start`.
  const FigureFunction& function(const std::string& name, std::size_t start) {
    const std::span<const FigureFunction> all = figure_functions();
    for (const auto spelling : {&FigureFunction::name, &FigureFunction::alias}) {
      if (const auto found = std::ranges::find(all, name, spelling); found != all.end()) return *found;
    }
    std::vector<std::string> known;
    for (const FigureFunction& row : all) known.emplace_back(row.name);
    known.emplace_back("abs");
    at_ = start;
    fail(fmt::format("`{:.80}` is not a function", name), suggestion(name, known));
  }

  void selector(Measure& measure) {
    skip_blanks();
    const std::size_t start = at_;
    const std::string text = argument("a selector");
    const std::size_t sign = text.find('=');
    const std::string key = text.substr(0, sign);
    const std::vector<Selector>& selectors = measure.function->selectors;
    const auto found = std::ranges::find(selectors, key, selector_name);
    const bool is_known = found != selectors.end() && sign != std::string::npos;
    if (is_known && select(measure, *found, text.substr(sign + 1))) return;
    at_ = start;
    if (is_known) fail(fmt::format("`{:.80}` is not a value, or is the second one", text), "write each selector once");
    std::vector<std::string> known;
    known.reserve(selectors.size());
    for (const Selector selector : selectors) known.emplace_back(selector_name(selector));
    fail(fmt::format("`{:.80}` selects nothing of {}", text, measure.function->name), suggestion(key, known));
  }

  // Whether the value is one of the selector's, and its first.
  static bool select(Measure& measure, Selector selector, std::string value) {
    if (selector == Selector::distance) {
      value = shortest<double>(value, -std::numeric_limits<double>::infinity());
    } else if (selector == Selector::frame || selector == Selector::spp) {
      value = shortest<int>(value, selector == Selector::frame ? 0 : 1);
    }
    return !value.empty() && measure.selected.emplace(selector, value).second;
  }

  // A number in one style; empty if it is none, or below `least`.
  template <typename T>
  static std::string shortest(const std::string& text, T least) {
    const auto value = parse_whole_of<T>(text);
    return value && *value >= least ? fmt::format("{}", *value) : std::string();
  }

  // Up to the next comma or parenthesis, without blanks around it.
  std::string argument(const std::string& what) {
    skip_blanks();
    const std::size_t stop = std::min(text_.find_first_of(",()", at_), text_.size());
    std::string_view found = text_.substr(at_, stop - at_);
    while (!found.empty() && is_blank(found.back())) found.remove_suffix(1);
    if (found.empty()) fail(what + " is missing", "write a call such as error(toksvig, distance=4)");
    at_ = stop;
    return std::string(found);
  }

  static Expression binary(char operation, Expression left, Expression right) {
    Expression node;
    node.kind = Kind::binary;
    node.operation = operation;
    node.parts = {std::move(left), std::move(right)};
    return node;
  }

  char take_one_of(std::string_view characters) {
    skip_blanks();
    if (at_ >= text_.size() || characters.find(text_[at_]) == std::string_view::npos) return 0;
    return text_[at_++];
  }

  void expect(char character) {
    if (take_one_of(std::string_view(&character, 1)) == 0) {
      fail(fmt::format("`{}` is missing", character), "add it");
    }
  }

  void skip_blanks() {
    while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
  }

  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
  static bool is_letter(char c) { return (c >= 'a' && c <= 'z') || c == '_'; }
  static bool is_digit(char c) { return c >= '0' && c <= '9'; }

  [[noreturn]] void fail(const std::string& message, const std::string& hint) const {
    throw Error(ErrorKind::usage, fmt::format("{}, column {}", place_, at_ + 1), message, hint);
  }

  std::string_view text_;
  std::string place_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

void collect(const Expression& node, std::vector<Measure>& measures) {
  if (node.kind == Kind::call) measures.push_back(node.measure);
  for (const Expression& part : node.parts) collect(part, measures);
}

class Evaluator {
 public:
  explicit Evaluator(std::span<const Results> runs) : runs_(runs) {}

  Evaluation run(const Expression& node) {
    found_.value = value(node);
    if (found_.problem.empty()) found_.problem = mixed_hosts_message(found_.nodes);
    if (!found_.problem.empty()) found_.value.reset();
    if (found_.value && std::isnan(*found_.value)) {
      found_.value.reset();
      found_.problem = "the value is not a number";
    }
    return std::move(found_);
  }

 private:
  // 0 if there is a problem, which is reported instead of the value.
  double value(const Expression& node) {
    if (node.kind == Kind::number) return node.number;
    if (node.kind == Kind::call) return call(node.measure);
    const double left = value(node.parts[0]);
    if (node.kind == Kind::negate) return -left;
    if (node.kind == Kind::absolute) return std::abs(left);
    const double right = value(node.parts[1]);
    if (node.operation == '+') return left + right;
    if (node.operation == '-') return left - right;
    if (node.operation == '*') return left * right;
    if (right == 0) return trouble(node.text() + ": division by 0");
    return left / right;
  }

  double call(const Measure& measure) {
    const Measured answer = measured(measure, runs_);
    if (!answer.value) return trouble(answer.text + ": " + answer.problem);
    if (std::ranges::find(found_.calls, answer.text, &Measured::text) == found_.calls.end())
      found_.calls.push_back(answer);
    found_.nodes.insert(answer.nodes.begin(), answer.nodes.end());
    return *answer.value;
  }

  double trouble(const std::string& problem) {
    if (found_.problem.empty()) found_.problem = problem;
    return 0;
  }

  std::span<const Results> runs_;
  Evaluation found_;
};

}  // namespace

Expression::Expression(const std::string& text, const std::string& place) {
  Parser parser(text, place);
  *this = parser.sum();
  parser.end();
}

std::vector<Measure> Expression::measures() const {
  std::vector<Measure> found;
  collect(*this, found);
  return found;
}

void Expression::for_each_measure(const std::function<void(Measure&)>& change) {
  if (kind == Kind::call) change(measure);
  for (Expression& part : parts) part.for_each_measure(change);
}

Expression Expression::with_method(const std::string& method) const {
  Expression filled = *this;
  filled.for_each_measure([&](Measure& called) {
    if (called.method == "*") called.method = method;
  });
  return filled;
}

std::string Expression::text() const {
  const auto operand = [](const Expression& part) {
    return part.kind == Kind::binary ? fmt::format("({})", part.text()) : part.text();
  };
  if (kind == Kind::number) return fmt::format("{}", number);
  if (kind == Kind::call) return measure_text(measure);
  if (kind == Kind::negate) return fmt::format("-{}", operand(parts[0]));
  if (kind == Kind::absolute) return fmt::format("abs({})", parts[0].text());
  return fmt::format("{} {} {}", operand(parts[0]), operation, operand(parts[1]));
}

Evaluation Expression::evaluate(std::span<const Results> runs) const { return Evaluator(runs).run(*this); }

Inequality::Inequality(const std::string& text, const std::string& place) {
  Parser parser(text, place);
  left = parser.sum();
  relation = parser.relation();
  right = parser.sum();
  parser.end();
}

bool Inequality::is_true(double left_value, double right_value) const {
  if (relation == "<") return left_value < right_value;
  if (relation == "<=") return left_value <= right_value;
  if (relation == ">") return left_value > right_value;
  return left_value >= right_value;
}

void Inequality::for_each_measure(const std::function<void(Measure&)>& change) {
  left.for_each_measure(change);
  right.for_each_measure(change);
}

}  // namespace footprint
