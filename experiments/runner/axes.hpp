// The values that settings take in turn, and all their combinations: what a [matrix] and a [region] are made of.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/runner/experiment.hpp"

namespace footprint {

class TomlTable;

/// The largest number of members of a matrix, or of settings of a region: each has a folder and a comparison.
inline constexpr std::size_t most_members = 1000;

/// The largest number of methods of an experiment: one comparison stores all of them at once.
inline constexpr std::size_t most_methods = 200;

/// The settings that an axis may vary, of [`table`] or, without a table, all.
[[nodiscard]] std::vector<std::string> axis_keys(std::string_view table = {});

/// Sets an axis_keys setting of an experiment as its file would. Errors (usage): the setting does not take the value.
void set_value(Experiment& experiment, const std::string& key, const std::string& value);

/// The values of one of the axis_keys. Errors (usage) name file, line and key: a value that the setting does not take,
/// or one that is there twice.
[[nodiscard]] Axis read_axis(const TomlTable& table, const std::string& key);

/// `text` with every combination of the options that `table` varies for the method that it calls `method`; an option
/// that `text` has already takes the new values. Errors (usage): nothing is varied, or more than most_methods.
[[nodiscard]] std::vector<std::string> times_options(const TomlTable& table, const std::string& method,
                                                     const std::string& text);

/// All combinations of the axes' values, the last axis first to change.
[[nodiscard]] std::vector<Coordinates> multiplied_out(const std::vector<Axis>& axes);

/// A name for each place that a folder may have, distinct from each other and from `others`.
[[nodiscard]] std::vector<std::string> names_of_places(const std::vector<Coordinates>& places,
                                                       std::vector<std::string> others);

}  // namespace footprint
