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
  return check.operation([range](std::string& text) {
    return std::isnan(std::strtod(text.c_str(), nullptr)) ? "Value " + text + " is not a number" : range(text);
  });
}

}  // namespace footprint
