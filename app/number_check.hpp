// The range of a number on the command line.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <string>

namespace footprint {

/// A check of a number from `low` to `high`, both inclusive. Unlike CLI::Range it refuses NaN, and prints short limits.
[[nodiscard]] inline CLI::Validator within(double low, double high) {
  const std::string range = fmt::format("{:g} to {:g}", low, high);
  return {[low, high, range](std::string& text) {
            double value = 0.0;
            if (!CLI::detail::lexical_cast(text, value) || std::isnan(value))
              return "Value " + text + " is not a number";
            return value >= low && value <= high ? std::string() : "Value " + text + " not in range " + range;
          },
          fmt::format("FLOAT in [{:g} - {:g}]", low, high)};
}

}  // namespace footprint
