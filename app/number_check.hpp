// The range of a number on the command line.
#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <string>

namespace footprint {

/// A check of a number from `low` to `high`, both inclusive. Unlike CLI::Range it refuses NaN.
[[nodiscard]] inline CLI::Validator within(double low, double high) {
  const CLI::Range range(low, high);
  CLI::Validator check = range;
  return check.operation([range, high](std::string& text) {
    std::string beyond = std::to_string(2.0 * std::abs(high) + 1.0);
    const bool is_nan = std::isnan(std::strtod(text.c_str(), nullptr));
    const std::string problem = range(is_nan ? beyond : text);
    return is_nan ? "Value " + text + problem.substr(problem.find(" not in range")) : problem;
  });
}

}  // namespace footprint
