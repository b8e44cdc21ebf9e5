// A method's options: a table for --help, configuration files, documents and reports.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace footprint {

/// One option as its owner declares it. A choice has `choices`; a number has a range.
struct OptionSpec {
  std::string name;
  std::variant<double, std::string> default_value;
  double minimum = 0.0, maximum = 0.0;  ///< numbers only, both inclusive
  std::vector<std::string> choices{};   ///< words only
  std::string meaning{};                ///< one sentence, with units
  bool integer = false;                 ///< numbers only: whole numbers
  /// The name in shaders if it differs, so that two methods with a common text may name an option differently.
  std::string name_in_shaders{};

  [[nodiscard]] const std::string& shader_name() const { return name_in_shaders.empty() ? name : name_in_shaders; }
};

/// The option with another name in shaders.
[[nodiscard]] OptionSpec named_in_shaders(OptionSpec option, std::string name);

/// A numeric option with an inclusive range.
[[nodiscard]] OptionSpec number_option(std::string name, double value, double minimum, double maximum,
                                       std::string meaning);

/// A numeric option for whole numbers.
[[nodiscard]] OptionSpec whole_option(std::string name, int value, int minimum, int maximum, std::string meaning);

/// An option with a choice of words; the first is the default.
[[nodiscard]] OptionSpec word_option(std::string name, const std::vector<std::string>& choices, std::string meaning);

/// Values for a table of options: every option present, defaults filled in.
class Options {
 public:
  /// Checks `given` against `specs`. Throws Error (usage): unknown name or choice (with the nearest right one), not a
  /// number, out of range; `owner` is named in the text.
  Options(const std::vector<OptionSpec>& specs, const std::map<std::string, std::string>& given,
          std::string_view owner);

  /// The value of a number or a word that the table declares.
  [[nodiscard]] double number(std::string_view name) const;
  [[nodiscard]] const std::string& word(std::string_view name) const;
  [[nodiscard]] const std::map<std::string, std::variant<double, std::string>, std::less<>>& all() const {
    return values_;
  }
  /// The table.
  [[nodiscard]] const std::vector<OptionSpec>& specs() const { return specs_; }

 private:
  std::vector<OptionSpec> specs_;
  std::map<std::string, std::variant<double, std::string>, std::less<>> values_;
};

struct Method;  // renderer/bake/method.hpp

/// A method as written on the command line: `name` or `name:option=value:option=value`.
struct MethodSpec {
  std::string text;  ///< as written
  std::string name;
  std::map<std::string, std::string> options;
  std::map<std::string, std::string> history{};  ///< options of the history of its frames (temporal.md)
  std::shared_ptr<const Method> file{};  ///< read from the file that `name` names; null: a method of the program
};

/// Splits "a,b:x=1:y=2". Throws Error (usage): empty names, an option without `=`, an option or a text given twice.
[[nodiscard]] std::vector<MethodSpec> parse_methods(std::string_view list);

}  // namespace footprint
