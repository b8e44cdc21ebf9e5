// Reads methods, checks them against those of the program, and finds their figures that no picture shows.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "methods/quantities.hpp"
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

}  // namespace footprint
