// Lines become statements: comments end them, backslashes continue them.
#include "renderer/scene/obj/statements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <utility>

#include "renderer/core/bytes.hpp"
#include "renderer/core/names.hpp"
#include "renderer/core/process.hpp"

namespace footprint {
namespace {

constexpr std::string_view blanks = " \t\v\f";
constexpr std::string_view utf8_mark = "\xEF\xBB\xBF";

// Why the bytes are not a text of 8-bit characters; empty if they may be one.
std::string_view foreign_encoding(std::string_view text) {
  if (text.starts_with(std::string_view("\xFF\xFE\0\0", 4)) || text.starts_with(std::string_view("\0\0\xFE\xFF", 4)))
    return "is UTF-32 text";
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) return "is UTF-16 text";
  if (text.find('\0') == std::string_view::npos) return {};
  const auto start = text.substr(0, 64);
  const auto zeros = static_cast<std::size_t>(std::ranges::count(start, '\0'));
  return 3 * zeros > start.size() ? "is UTF-16 text without a byte order mark"
                                  : "has bytes of 0: it is not a text file";
}

// Cuts off a comment. A "#" within a name, or in "1.#IND", begins none.
std::string_view without_comment(std::string_view line) {
  std::string_view rest = line;
  const bool may_hold_names = next_word(rest).size() > 2;
  for (std::size_t at = line.find('#'); at != std::string_view::npos; at = line.find('#', at + 1)) {
    const char before = at == 0 ? ' ' : line[at - 1];
    const bool is_in_word = blanks.find(before) == std::string_view::npos;
    if (!is_in_word || (!may_hold_names && before != '.')) return line.substr(0, at);
  }
  return line;
}

// The length of the UTF-8 character at the start of a text; 0 if there is none.
std::size_t utf8_length(std::string_view text) {
  const auto first = static_cast<unsigned char>(text.front());
  const std::size_t length = first < 0x80U                     ? 1
                             : first >= 0xC2U && first < 0xE0U ? 2
                             : (first & 0xF0U) == 0xE0U        ? 3
                             : first >= 0xF0U && first < 0xF5U ? 4
                                                               : 0;
  if (length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((static_cast<unsigned char>(text[i]) & 0xC0U) != 0x80U) return 0;
  if (length > 2) {
    const auto second = static_cast<unsigned char>(text[1]);
    const bool is_overlong = (first == 0xE0U && second < 0xA0U) || (first == 0xF0U && second < 0x90U);
    const bool is_beyond = (first == 0xEDU && second >= 0xA0U) || (first == 0xF4U && second >= 0x90U);
    if (is_overlong || is_beyond) return 0;
  }
  return length;
}

}  // namespace

WavefrontFile::WavefrontFile(std::filesystem::path file, std::uint64_t largest)
    : file_(std::move(file)),
      bytes_(read_file_bytes(file_, largest)),
      text_(reinterpret_cast<const char*>(bytes_.data()), bytes_.size()) {
  if (const std::string_view encoding = foreign_encoding(text_); !encoding.empty()) {
    throw Error(ErrorKind::usage, file_.string(), std::string(encoding), "save it as text in ASCII or UTF-8");
  }
  if (text_.starts_with(utf8_mark)) text_.remove_prefix(utf8_mark.size());
}

std::string_view WavefrontFile::next_line() {
  ++line_;
  if (line_ % 4096 == 0) throw_if_interrupted();
  const std::string_view line = text_.substr(0, text_.find_first_of("\r\n"));
  text_.remove_prefix(line.size());
  text_.remove_prefix(text_.starts_with("\r\n") ? 2 : std::min<std::size_t>(text_.size(), 1));
  return line;
}

std::optional<WavefrontStatement> WavefrontFile::next() {
  while (!text_.empty()) {
    std::string_view statement = without_blanks(without_comment(next_line()));
    const std::size_t first = line_;
    if (statement.ends_with('\\')) {
      joined_.clear();
      while (statement.ends_with('\\')) {
        joined_.append(statement.substr(0, statement.size() - 1)).append(" ");
        statement = text_.empty() ? std::string_view{} : without_blanks(without_comment(next_line()));
      }
      statement = without_blanks(joined_.append(statement));
    }
    const std::string_view keyword = next_word(statement);
    if (!keyword.empty()) return WavefrontStatement{first, keyword, without_blanks(statement)};
  }
  return std::nullopt;
}

Error WavefrontFile::fault(std::size_t line, const std::string& message) const {
  return {ErrorKind::usage, fmt::format("{}:{}", file_.string(), line), message, "repair the file or export it again"};
}

std::string_view next_word(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
  const std::string_view word = text.substr(0, text.find_first_of(blanks));
  text.remove_prefix(word.size());
  return word;
}

std::string_view without_blanks(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
  return text.substr(0, text.find_last_not_of(blanks) + 1);
}

std::optional<double> wavefront_number(std::string_view word) {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  const char* const end = word.data() + word.size();
  double number = 0.0;
  const auto [stop, status] = std::from_chars(word.data(), end, number);
  if (stop == end && status == std::errc{}) return number;
  if (stop == end && status == std::errc::result_out_of_range) {
    const bool is_tiny = word.find("e-") != std::string_view::npos || word.find("E-") != std::string_view::npos;
    return is_tiny ? 0.0 : std::numeric_limits<double>::infinity();
  }
  const std::string_view digits = word.starts_with('-') ? word.substr(1) : word;
  if (digits.starts_with("1.#")) return std::numeric_limits<double>::quiet_NaN();
  return std::nullopt;
}

std::filesystem::path find_named_file(const std::filesystem::path& folder, std::string name) {
  namespace fs = std::filesystem;
  std::error_code error;
  if (name.empty()) return {};
  if (fs::path path = folder / name; fs::is_regular_file(path, error)) return path;
  std::ranges::replace(name, '\\', '/');
  if (fs::path path = folder / name; fs::is_regular_file(path, error)) return path;
  const bool is_absolute = name.starts_with('/') || (name.size() > 1 && name[1] == ':');
  fs::path path = folder / fs::path(name).filename();
  return is_absolute && fs::is_regular_file(path, error) ? path : fs::path{};
}

std::string utf8_text(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    const auto byte = static_cast<unsigned char>(text.front());
    if (length > 0) {
      out += text.substr(0, length);
    } else {
      out += static_cast<char>(0xC0U | static_cast<unsigned>(byte >> 6U));
      out += static_cast<char>(0x80U | (byte & 0x3FU));
    }
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return out;
}

}  // namespace footprint
