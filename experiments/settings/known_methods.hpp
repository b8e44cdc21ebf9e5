// Methods of a run: read, checked against those of the program, their figures that no image shows, and their histories.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "experiments/settings/run_settings.hpp"
#include "methods/registry.hpp"
#include "renderer/core/options.hpp"

namespace footprint {

/// Checks methods and their options, and reads those that are files (read_method_file).
/// folder: where a file's relative path starts.
/// Errors (usage): unknown method or option, with the nearest name; a file's.
void take_known(std::span<MethodSpec> methods, const std::filesystem::path& folder);

/// Comma-separated methods with their options, checked before anything is loaded. Errors (usage): those of take_known.
[[nodiscard]] std::vector<MethodSpec> parse_known_methods(const std::string& text,
                                                          const std::filesystem::path& folder = {});

/// The methods as they were written.
[[nodiscard]] std::vector<std::string> texts_of(const std::vector<MethodSpec>& methods);

/// Every method of the program except slow ones (MethodInfo::slow_frame), with its defaults.
[[nodiscard]] std::vector<MethodSpec> every_method();

/// A method's figure of that name; null where it has none.
[[nodiscard]] const Quantity* find_quantity(const Method& method, const std::string& name);

/// The names of all figures of some methods, each once.
[[nodiscard]] std::vector<std::string> quantity_names(std::span<const MethodSpec> methods);

/// Methods, each of which may have options of its own history. Errors (usage): those of parse_known_methods, or a value
/// that its option does not take.
[[nodiscard]] std::vector<MethodSpec> parse_methods_with_histories(const std::string& text,
                                                                   const std::filesystem::path& folder = {});

/// The history of a method's frames.
/// common: that of the run's methods; options of the method's own replace it.
[[nodiscard]] HistorySettings history_of(const MethodSpec& method, const HistorySettings& common);

/// The number of a run's methods whose images are histories.
[[nodiscard]] std::size_t count_histories(const RunSettings& run);

}  // namespace footprint
