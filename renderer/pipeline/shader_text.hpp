// The text of one stage: shared files and a module, without the parts that the scene does not need.
#pragma once

#include <set>
#include <string>
#include <string_view>

#include "renderer/bake/method.hpp"

namespace footprint {

/// The compiler's line numbers of shared text start here. A module's lines have the numbers of its own file, and the
/// files of its folder that it includes follow at further numbers. (Source strings would separate files, but Mesa's
/// messages always name string 0.)
inline constexpr int first_shared_line = 100001;

/// Assembles a stage. renderer/shaders/README.md documents the directives; each file is included once. Throws Error
/// (usage) with file and line: an unknown flag, with the nearest known one; a directive that is unknown, out of order
/// or not closed; an `include` of an unknown file.
class ShaderText {
 public:
  /// flags: all known flags, to which those of `module` are added.
  /// module: replaces the directive `module`; none if it has no file.
  explicit ShaderText(ShaderFlags flags, ShaderModule module = {});

  /// Adds text without reading directives.
  void add(std::string_view text);
  /// Adds a shared file, unless it was added before.
  void include(std::string_view file);
  /// Adds the module.
  void include_module();

  [[nodiscard]] const std::string& text() const { return text_; }
  /// The files behind line numbers: "lines from 1 on are of lean.glsl, from 100001 on shared".
  [[nodiscard]] const std::string& lines() const { return lines_; }

 private:
  class Reader;
  [[nodiscard]] int shared_line() const;
  void include_shared(const EmbeddedText& text);
  void include_own(const EmbeddedText& text);

  ShaderFlags flags_;
  ShaderModule module_;
  std::set<std::string_view> included_;
  int next_own_line_ = 1;
  std::string text_, lines_;
};

}  // namespace footprint
