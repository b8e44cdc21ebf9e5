// Texts that are compiled into the program: footprint_embed (cmake/FootprintHelpers.cmake) writes a table a library.
#pragma once

#include <algorithm>
#include <span>
#include <string_view>

namespace footprint {

/// A file's text.
struct EmbeddedText {
  std::string_view file, text;
};

/// The texts of a folder, sorted by file name.
using EmbeddedTexts = std::span<const EmbeddedText>;

/// The text of a file; null if there is no such file.
[[nodiscard]] inline const EmbeddedText* find_text(EmbeddedTexts texts, std::string_view file) {
  const auto found = std::ranges::lower_bound(texts, file, {}, &EmbeddedText::file);
  return found == texts.end() || found->file != file ? nullptr : &*found;
}

}  // namespace footprint
