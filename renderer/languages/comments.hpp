// The comments of GLSL for a translation of it, because SPIR-V has none.
#pragma once

#include <string>

namespace footprint {

/// Inserts the comments of `glsl` before functions and structures of the same name in `text`, and behind members of
/// those structures. A comment is lines of `//` without indentation just above. Functions of one name get the first
/// comment, once.
/// text: a translation by SPIRV-Cross.
[[nodiscard]] std::string with_comments(const std::string& text, const std::string& glsl);

}  // namespace footprint
