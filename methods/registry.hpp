// The methods of this build. CMake writes the list: one footprint_add_method line per method.
#pragma once

#include <span>
#include <string>

#include "renderer/bake/method.hpp"

namespace footprint {

/// All methods, in the order of methods/CMakeLists.txt.
[[nodiscard]] std::span<const Method* const> all_methods();

/// The method of a name. Errors (usage): unknown, with the nearest right one.
[[nodiscard]] const Method& find_method(const std::string& name);

/// The method of a spec: of the file that it names, or of its name. Errors (usage): as above.
[[nodiscard]] const Method& find_method(const MethodSpec& spec);

}  // namespace footprint
