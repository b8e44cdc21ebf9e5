// A method's GLSL as it is handed to the pipeline.
#pragma once

#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "renderer/core/embedded_texts.hpp"

namespace footprint {

/// Every flag that a text may ask for, and whether it is on.
using ShaderFlags = std::map<std::string, bool, std::less<>>;

/// A text with directives (renderer/shaders/README.md): a method's module, or a pass of its frame build.
struct ShaderModule {
  std::string_view file;  ///< messages name it
  std::string_view text;
  EmbeddedTexts folder{};  ///< what it may include, beside the shared texts
  ShaderFlags flags{};     ///< of its own, beside those of scene, sampling and options
};

/// The module in a file of a folder. Errors: std::logic_error where the folder has no such file.
[[nodiscard]] inline ShaderModule module_of(EmbeddedTexts folder, std::string_view file, ShaderFlags flags = {}) {
  const EmbeddedText* const found = find_text(folder, file);
  if (found == nullptr) throw std::logic_error("no text `" + std::string(file) + "` is embedded");
  return {found->file, found->text, folder, std::move(flags)};
}

}  // namespace footprint
