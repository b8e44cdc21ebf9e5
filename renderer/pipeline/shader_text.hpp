// The text of one stage: put together from shared files and a module, without what the scene does not call for.
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <string_view>

#include "renderer/bake/shader_module.hpp"

namespace footprint {

/// The compiler's numbers of the shared lines begin here. A module's lines have the numbers of its own file; those of
/// files of its folder that it includes follow, each file from a number of its own. (Source strings would tell files
/// apart, but Mesa's messages always name string 0.)
inline constexpr int first_shared_line = 100001;

/// Puts a stage together. Directives are those of renderer/shaders/README.md; each file is included once.
/// Errors (usage) name file and line: a flag that is not known, with the nearest that is; a directive that is unknown,
/// out of its order or not closed; an `include` of what is no text.
class ShaderText {
 public:
  /// `flags`: all that may be asked for. `module`, whose own flags come to them, takes the place of the directive
  /// `module`; one without a file is none.
  explicit ShaderText(ShaderFlags flags, ShaderModule module = {});

  /// Adds text as it is.
  void add(std::string_view text);
  /// Adds the shared text of a file, unless it is there.
  void include(std::string_view file);
  /// Adds the module.
  void include_module();

  [[nodiscard]] const std::string& text() const { return text_; }
  /// Whose the lines of a compiler's message are: "lines from 1 on are of lean.glsl, from 100001 on shared".
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
