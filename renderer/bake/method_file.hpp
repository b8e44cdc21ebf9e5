// A method in one GLSL file: a head in TOML that says what is baked, and a module (docs/guides/method-files.md).
#pragma once

#include <filesystem>
#include <memory>
#include <string_view>

#include "renderer/bake/method.hpp"

namespace footprint {

/// Whether a method's name is that of a file.
[[nodiscard]] inline bool names_method_file(std::string_view name) { return name.ends_with(".glsl"); }

/// The method of a module with a head, which must outlive it. Errors (usage) name FILE:LINE.
[[nodiscard]] Method method_of(const ShaderModule& module);

/// Reads a method from a file of at most 256 KiB, with the images that it names.
/// folder: where a relative path starts; empty: the working directory.
/// Errors (usage) name `name`, and the line: missing, too large, not a text, or its head is wrong.
[[nodiscard]] std::shared_ptr<const Method> read_method_file(std::string_view name,
                                                             const std::filesystem::path& folder = {});

}  // namespace footprint
