// The value of a setting as it was given, before its type reads it.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "renderer/core/numbers.hpp"
#include "renderer/core/toml_table.hpp"

namespace footprint {

/// The text of an option, or a value of a file with its type: a number of a file never becomes a text on its way.
class SettingInput {
 public:
  SettingInput(std::string text)
      : value_(TomlScalar(std::move(text))) {}  // NOLINT(google-explicit-constructor): options are texts
  SettingInput(const char* text) : SettingInput(std::string(text)) {}
  explicit SettingInput(TomlScalar value) : value_(std::move(value)) {}
  explicit SettingInput(std::vector<TomlScalar> list) : value_(std::move(list)) {}

  /// The value as an option would have it, for words and messages.
  [[nodiscard]] std::string text() const {
    if (const auto* const list = std::get_if<std::vector<TomlScalar>>(&value_)) {
      std::vector<std::string> texts;
      for (const TomlScalar& part : *list) texts.push_back(SettingInput(part).text());
      return fmt::format("{}", fmt::join(texts, ","));
    }
    return std::visit([](const auto& value) { return fmt::format("{}", value); }, std::get<TomlScalar>(value_));
  }

  /// The value as a number; none if it is not one, or not finite.
  [[nodiscard]] std::optional<double> number() const {
    const std::optional<double> number = as<double>();
    return number && std::isfinite(*number) ? number : std::nullopt;
  }

  /// The value as a whole number that fits the type; none if it is not one. A file may write it with a fraction of 0.
  template <typename Number>
  [[nodiscard]] std::optional<Number> whole() const {
    return as<Number>();
  }

  /// Whether a switch is on; none if it is neither.
  [[nodiscard]] std::optional<bool> boolean() const {
    const TomlScalar* const scalar = std::get_if<TomlScalar>(&value_);
    const bool* const value = scalar != nullptr ? std::get_if<bool>(scalar) : nullptr;
    return value != nullptr ? std::optional(*value) : std::nullopt;
  }

  /// The elements of a list, or the parts of a text between separators.
  [[nodiscard]] std::vector<SettingInput> parts(char separator = ',') const {
    std::vector<SettingInput> all;
    if (const auto* const list = std::get_if<std::vector<TomlScalar>>(&value_)) {
      for (const TomlScalar& part : *list) all.emplace_back(part);
    } else {
      for (std::string& part : parts_of(text(), separator)) all.emplace_back(std::move(part));
    }
    return all;
  }

 private:
  template <typename Number>
  [[nodiscard]] std::optional<Number> as() const {
    const TomlScalar* const scalar = std::get_if<TomlScalar>(&value_);
    return scalar != nullptr ? std::visit([](const auto& value) { return converted<Number>(value); }, *scalar)
                             : std::nullopt;
  }
  template <typename Number>
  static std::optional<Number> converted(const std::string& text) {
    return parse_whole_of<Number>(text);
  }
  template <typename Number>
  static std::optional<Number> converted(bool /*value*/) {
    return {};
  }
  template <typename Number>
  static std::optional<Number> converted(std::int64_t value) {
    if constexpr (std::is_floating_point_v<Number>) {
      return static_cast<Number>(value);
    } else {
      return std::in_range<Number>(value) ? std::optional(static_cast<Number>(value)) : std::nullopt;
    }
  }
  template <typename Number>
  static std::optional<Number> converted(double value) {
    constexpr double largest_exact = 9007199254740992.0;  // 2^53: beyond, doubles skip whole numbers
    if constexpr (std::is_floating_point_v<Number>) {
      return value;
    } else if (value != std::floor(value) || std::abs(value) > largest_exact) {  // also NaN
      return {};
    } else {
      return converted<Number>(static_cast<std::int64_t>(value));
    }
  }

  std::variant<TomlScalar, std::vector<TomlScalar>> value_;
};

}  // namespace footprint
