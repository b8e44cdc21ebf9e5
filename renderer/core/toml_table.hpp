// Strict reading of TOML tables: every key is checked, and errors name its line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "renderer/core/error.hpp"

// TOML++ is included by the source alone.
namespace toml::inline v3 {
class table;
}

namespace footprint {

/// An inclusive range of numbers.
struct NumberRange {
  double low, high;
};

/// A value of a key that is neither a list nor a table.
using TomlScalar = std::variant<std::string, bool, std::int64_t, double>;

/// One table of a TOML file. Readers return nothing if the key is missing. They throw Error (usage) "FILE:LINE" if the
/// value has the wrong type, is not finite or is out of range.
class TomlTable {
 public:
  /// Reads a whole file of at most 1 MiB.
  /// known: the allowed keys.
  /// Throws Error (usage) "FILE:LINE: ...": missing, empty, not TOML, or an unknown key, with the nearest known one.
  TomlTable(const std::filesystem::path& file, const std::vector<std::string>& known);

  /// Reads a part of a file, in front of which `text` has as many lines as the file.
  TomlTable(const std::filesystem::path& file, std::string_view text, const std::vector<std::string>& known);

  /// Reads a file over another with presets: tables that `file` lacks come from the presets, and so do keys that its
  /// `joined` tables lack. Errors name the file of their line.
  static TomlTable over_presets(const std::filesystem::path& file, const std::filesystem::path& presets,
                                const std::vector<std::string>& known, const std::vector<std::string>& joined);

  [[nodiscard]] bool has(std::string_view key) const;
  [[nodiscard]] bool is_word(std::string_view key) const;
  [[nodiscard]] bool is_table(std::string_view key) const;
  [[nodiscard]] std::optional<std::string> word(std::string_view key) const;
  /// A word out of `choices`: its index there.
  [[nodiscard]] std::optional<std::size_t> choice(std::string_view key, const std::vector<std::string>& choices) const;
  [[nodiscard]] std::optional<bool> boolean(std::string_view key) const;
  [[nodiscard]] std::optional<double> number(std::string_view key, NumberRange range) const;
  /// A number without a fraction.
  [[nodiscard]] std::optional<std::int64_t> whole_number(std::string_view key, NumberRange range) const;
  /// `count` numbers; a `count` of 0 accepts one or more.
  [[nodiscard]] std::optional<std::vector<double>> numbers(std::string_view key, std::size_t count,
                                                           NumberRange range) const;
  [[nodiscard]] std::optional<std::vector<std::string>> words(std::string_view key) const;
  /// Strings and numbers, one or more; numbers as they are written shortest.
  [[nodiscard]] std::optional<std::vector<std::string>> words_or_numbers(std::string_view key) const;
  /// A string, a number or a boolean, with its type.
  [[nodiscard]] std::optional<TomlScalar> scalar(std::string_view key) const;
  /// Strings and numbers, one or more, each with its type.
  [[nodiscard]] std::optional<std::vector<TomlScalar>> scalars(std::string_view key) const;
  [[nodiscard]] std::optional<TomlTable> table(std::string_view key, const std::vector<std::string>& known) const;
  /// The sorted keys of the table [key]; empty without that table.
  [[nodiscard]] std::vector<std::string> keys_of(std::string_view key) const;
  /// The tables of [[key]]; empty without any.
  [[nodiscard]] std::vector<TomlTable> tables(std::string_view key, const std::vector<std::string>& known) const;

  /// An error at `key`'s line, or at the table's if the key is missing.
  [[nodiscard]] Error error_at(std::string_view key, const std::string& message, const std::string& hint) const;

 private:
  /// `name` is for messages: "[frame]"; empty for the whole file.
  TomlTable(std::shared_ptr<const toml::table> table, std::filesystem::path file, std::string name,
            const std::vector<std::string>& known);

  template <class Convert>
  [[nodiscard]] auto read(std::string_view key, const std::string& message, const std::string& hint,
                          const Convert& convert) const;
  template <typename Node>
  [[nodiscard]] double checked(const Node& node, std::string_view key, NumberRange range) const;
  [[nodiscard]] std::string full_name(std::string_view key) const;
  /// The name of a key as the header of a table is written: "brdf.lobe".
  [[nodiscard]] std::string path_of(std::string_view key) const;

  std::shared_ptr<const toml::table> table_;  // shares the whole file
  std::filesystem::path file_;
  std::string name_;
};

/// The result of `read`; its errors become errors at the line of the key.
template <typename Read>
auto at_key(const TomlTable& table, std::string_view key, Read read) {
  try {
    return read();
  } catch (const Error& error) {
    const std::string place = error.place().empty() ? "" : error.place() + ": ";
    throw table.error_at(key, "cannot be taken: " + place + error.message(), error.hint());
  }
}

}  // namespace footprint
