// The statements of Wavefront files (OBJ and MTL), and the words and numbers in them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/core/error.hpp"

namespace footprint {

/// A statement without its comment.
struct WavefrontStatement {
  std::size_t line = 0;      ///< of its first word, from 1
  std::string_view keyword;  ///< such as "v"
  std::string_view rest;     ///< what follows the keyword, without blanks around it
};

/// Reads a Wavefront file statement by statement. Lines end with LF, CR or both; a backslash at the end of one
/// continues it; a byte order mark of UTF-8 is skipped.
class WavefrontFile {
 public:
  /// largest: in bytes. Throws Error (usage) that names the file: as read_file_bytes; UTF-16, UTF-32 or binary data.
  WavefrontFile(std::filesystem::path file, std::uint64_t largest);

  /// The next statement; none at the end. Its texts are valid until the next call. Throws Error if the process is
  /// interrupted.
  [[nodiscard]] std::optional<WavefrontStatement> next();

  /// An error (usage) with file and line.
  [[nodiscard]] Error fault(std::size_t line, const std::string& message) const;

  [[nodiscard]] const std::filesystem::path& path() const { return file_; }

 private:
  std::string_view next_line();

  std::filesystem::path file_;
  std::vector<std::uint8_t> bytes_;
  std::string_view text_;  // what is left of `bytes_`
  std::string joined_;     // a continued statement
  std::size_t line_ = 0;
};

/// Takes the next word off a text; empty at its end.
[[nodiscard]] std::string_view next_word(std::string_view& text);

/// A text without blanks at its ends.
[[nodiscard]] std::string_view without_blanks(std::string_view text);

/// A word as a number: also with a plus sign, and rounded to 0 or infinity beyond what a double can store. "nan", "inf"
/// and the spellings of Windows such as "1.#IND" are not finite. None: not a number.
[[nodiscard]] std::optional<double> wavefront_number(std::string_view word);

/// The file that a statement names, from the folder of its file; empty if there is none. Backslashes may separate
/// folders. Absolute names are those of another machine: only their last part counts if nothing is there.
[[nodiscard]] std::filesystem::path find_named_file(const std::filesystem::path& folder, std::string name);

/// Bytes that are not UTF-8 as Latin-1, so that every name can be printed and stored as JSON.
[[nodiscard]] std::string utf8_text(std::string_view text);

}  // namespace footprint
