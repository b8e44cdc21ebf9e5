// Methods as they are written, held against those that the program has.
#pragma once

#include <string>
#include <vector>

#include "renderer/core/options.hpp"

namespace footprint {

/// Methods with their options, commas between, known to be right before anything is loaded. Errors (usage): unknown
/// method or option, with the nearest.
[[nodiscard]] std::vector<MethodSpec> parse_known_methods(const std::string& text);

/// The methods as they were written.
[[nodiscard]] std::vector<std::string> texts_of(const std::vector<MethodSpec>& methods);

/// Every method of the program but those that are slow (MethodInfo::slow_frame), with its own defaults.
[[nodiscard]] std::vector<MethodSpec> every_method();

}  // namespace footprint
