// Whether this build has the compilers of shaders. Vulkan's headers, glslang and SPIRV-Cross are one optional component
// (FOOTPRINT_SHADER_COMPILERS).
#pragma once

#include <string>

#include "renderer/core/error.hpp"

namespace footprint {

/// The error of a build without the component, with what it lacks and the packages to install.
/// place: the option or subcommand that needs it.
[[nodiscard]] Error missing_compilers(const std::string& place);

/// Checks the build before work begins. Throws missing_compilers(place) if it lacks the component.
void require_compilers(const std::string& place);

}  // namespace footprint
