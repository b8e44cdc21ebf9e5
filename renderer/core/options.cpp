// Takes method texts apart and checks each value against its row of the table: a number's range, a word's choices.
#include "renderer/core/options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <span>

#include "renderer/core/error.hpp"
#include "renderer/core/names.hpp"
#include "renderer/core/numbers.hpp"

namespace footprint {
namespace {

using Value = std::variant<double, std::string>;

double parse_number(const OptionSpec& spec, const std::string& text, std::string_view owner) {
  const auto number = parse_whole_of<double>(text);
  const bool fits = number && std::isfinite(*number) && *number >= spec.minimum && *number <= spec.maximum &&
                    (!spec.integer || *number == std::floor(*number));
  if (fits) return *number;
  throw Error(
      ErrorKind::usage, fmt::format("{}, option {}", owner, spec.name), fmt::format("`{}` is not valid", text),
      fmt::format("give a {} from {} to {}", spec.integer ? "whole number" : "number", spec.minimum, spec.maximum));
}

std::string parse_word(const OptionSpec& spec, const std::string& text, std::string_view owner) {
  return spec.choices[find_word(spec.choices, text, "value", fmt::format("{}, option {}", owner, spec.name))];
}

Value parse_value(const OptionSpec& spec, const std::string& text, std::string_view owner) {
  if (std::holds_alternative<double>(spec.default_value)) return parse_number(spec, text, owner);
  return parse_word(spec, text, owner);
}

MethodSpec parse_method(std::string_view text) {
  const auto bad = [&](const std::string& message) {
    return Error(ErrorKind::usage, fmt::format("method `{}`", text), message,
                 "write name or name:option=value:option=value");
  };
  const std::vector<std::string> parts = parts_of(text, ':');
  MethodSpec spec{.text = std::string(text), .name = parts.front(), .options = {}};
  if (spec.name.empty()) throw bad("a method has no name");
  for (const std::string& part : std::span(parts).subspan(1)) {
    const std::size_t equals = part.find('=');
    if (equals == std::string::npos || equals == 0) throw bad(fmt::format("option `{}` is not name=value", part));
    const bool fresh = spec.options.emplace(part.substr(0, equals), part.substr(equals + 1)).second;
    if (!fresh) throw bad(fmt::format("option `{}` is given twice", part.substr(0, equals)));
  }
  return spec;
}

}  // namespace

OptionSpec number_option(std::string name, double value, double minimum, double maximum, std::string meaning) {
  return {.name = std::move(name),
          .default_value = value,
          .minimum = minimum,
          .maximum = maximum,
          .meaning = std::move(meaning)};
}

OptionSpec whole_option(std::string name, int value, int minimum, int maximum, std::string meaning) {
  OptionSpec spec = number_option(std::move(name), value, minimum, maximum, std::move(meaning));
  spec.integer = true;
  return spec;
}

OptionSpec word_option(std::string name, const std::vector<std::string>& choices, std::string meaning) {
  return {.name = std::move(name), .default_value = choices.front(), .choices = choices, .meaning = std::move(meaning)};
}

OptionSpec named_in_shaders(OptionSpec option, std::string name) {
  option.name_in_shaders = std::move(name);
  return option;
}

Options::Options(const std::vector<OptionSpec>& specs, const std::map<std::string, std::string>& given,
                 std::string_view owner)
    : specs_(specs) {
  std::vector<std::string> names;
  for (const OptionSpec& spec : specs) {
    names.push_back(spec.name);
    values_[spec.name] = spec.default_value;
  }
  for (const auto& [name, text] : given) {
    const auto spec = std::ranges::find(specs, name, &OptionSpec::name);
    if (spec == specs.end()) {
      throw Error(ErrorKind::usage, std::string(owner), fmt::format("unknown option `{}`", name),
                  names.empty() ? "it takes no options" : suggestion(name, names));
    }
    values_[name] = parse_value(*spec, text, owner);
  }
}

double Options::number(std::string_view name) const { return std::get<double>(values_.find(name)->second); }

const std::string& Options::word(std::string_view name) const {
  return std::get<std::string>(values_.find(name)->second);
}

std::vector<MethodSpec> parse_methods(std::string_view list) {
  std::vector<MethodSpec> methods;
  std::set<std::string> seen;
  for (const std::string& part : parts_of(list)) {
    methods.push_back(parse_method(part));
    if (!seen.insert(part).second)
      throw Error(ErrorKind::usage, fmt::format("method `{}`", part), "given twice", "name each method once");
  }
  return methods;
}

}  // namespace footprint
