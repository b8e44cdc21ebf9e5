// The text of one stage: shared files and a module, without the parts that the scene does not need.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/bake/method.hpp"

namespace footprint {

/// The compiler's line numbers of shared text start here. A module's lines have the numbers of its own file, and the
/// files of its folder that it includes follow at further numbers. (Source strings would separate files, but Mesa's
/// messages always name string 0.)
inline constexpr int first_shared_line = 100001;

/// The file name by which shared text includes the method's module.
inline constexpr std::string_view method_module = "method_module.glsl";

/// Whether a character may be in a name or an integer of GLSL.
[[nodiscard]] bool is_in_word(char c);

/// The macro of a flag in conditions: `STORAGE_FP16` for `storage_fp16`.
[[nodiscard]] std::string macro_name(std::string_view flag);

/// Assembles a stage. Conditions of `#if` are evaluated here if they consist of flags, so that compilers, exports and
/// messages have only what the stage uses; each file is included once. renderer/shaders/README.md documents this.
/// Throws Error (usage) with file and line: an unknown flag, with the nearest known one; a directive that is unknown,
/// out of order or not closed; an `#include` of an unknown file; a directive of earlier versions.
class ShaderText {
 public:
  /// flags: all known flags, to which those of `module` are added.
  /// module: replaces `#include "method_module.glsl"`; none if it has no file.
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

  /// Where a line of the text is from.
  struct Origin {
    std::size_t offset;     ///< of the line in the text
    std::string_view file;  ///< shared, or of the module's folder
    int line;               ///< from 1
  };
  /// The origin of the character at `offset`; null in front of the first file.
  [[nodiscard]] const Origin* origin(std::size_t offset) const;

  /// Whether a file is one of the shared texts.
  [[nodiscard]] static bool is_shared(std::string_view file);

 private:
  class Reader;
  [[nodiscard]] int shared_line() const;
  void include_shared(const EmbeddedText& text);
  void include_own(const EmbeddedText& text);

  ShaderFlags flags_;
  ShaderModule module_;
  std::set<std::string_view> included_;
  std::set<std::string, std::less<>> macros_;  // of `#define` in the text
  int next_own_line_ = 1;
  std::string text_, lines_;
  std::vector<Origin> origins_;
};

}  // namespace footprint
