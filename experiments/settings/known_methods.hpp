// Reads methods, and checks them against those of the program.
#pragma once

#include <string>
#include <vector>

#include "renderer/core/options.hpp"

namespace footprint {

/// Comma-separated methods with their options, checked before anything is loaded. Errors (usage): unknown method or
/// option, with the nearest name.
[[nodiscard]] std::vector<MethodSpec> parse_known_methods(const std::string& text);

/// The methods as they were written.
[[nodiscard]] std::vector<std::string> texts_of(const std::vector<MethodSpec>& methods);

/// Every method of the program except slow ones (MethodInfo::slow_frame), with its defaults.
[[nodiscard]] std::vector<MethodSpec> every_method();

}  // namespace footprint
