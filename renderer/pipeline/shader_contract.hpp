// The functions that shared shaders call and a module defines.
#pragma once

#include <string_view>

#include "renderer/pipeline/shader_text.hpp"

namespace footprint {

/// Checks that a stage defines every function that a shared text declares by a prototype, and every structure in those
/// prototypes. A function that is declared under a condition counts only if it is called. method_contract.glsl declares
/// what a method's module defines; other shared texts declare what their includers define. module: the file of the
/// module, for messages. Throws Error (usage): names the file and the first function or structure that is missing, or
/// differs in its types.
void require_definitions(const ShaderText& text, std::string_view module);

}  // namespace footprint
