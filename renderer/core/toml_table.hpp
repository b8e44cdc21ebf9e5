// Strict reading of TOML tables: every key is asked for, checked and named with its line when it is wrong.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/core/error.hpp"

namespace footprint {

/// An inclusive range of numbers.
struct NumberRange {
  double low, high;
};

/// One table of a TOML file. Readers return nothing where the key is absent and throw Error{usage} "FILE:LINE" where
/// its value has the wrong type, is not finite or is out of range.
class TomlTable {
 public:
  /// A whole file of at most 1 MiB. `known` are the keys that may stand in it: any other is an error that names the
  /// nearest right one. Throws Error (usage): missing, empty, or not TOML, as "FILE:LINE: ...".
  TomlTable(const std::filesystem::path& file, const std::vector<std::string>& known);

  /// A whole file over another, its presets: a table that `file` lacks is that of the presets, and in the tables that
  /// `joined` names so is every key that it lacks. Errors, also later ones, name the file that their line is of.
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
  /// `count` numbers; a `count` of 0 takes any number of them but none.
  [[nodiscard]] std::optional<std::vector<double>> numbers(std::string_view key, std::size_t count,
                                                           NumberRange range) const;
  [[nodiscard]] std::optional<std::vector<std::string>> words(std::string_view key) const;
  /// Strings and numbers, one or more; numbers as they are written shortest.
  [[nodiscard]] std::optional<std::vector<std::string>> words_or_numbers(std::string_view key) const;
  [[nodiscard]] std::optional<TomlTable> table(std::string_view key, const std::vector<std::string>& known) const;
  /// The keys of the table [key], sorted; none where there is no such table.
  [[nodiscard]] std::vector<std::string> keys_of(std::string_view key) const;
  /// The tables of [[key]]; empty where there are none.
  [[nodiscard]] std::vector<TomlTable> tables(std::string_view key, const std::vector<std::string>& known) const;

  /// An error at `key`'s line (the table's, where the key is absent).
  [[nodiscard]] Error error_at(std::string_view key, const std::string& message, const std::string& hint) const;

 private:
  /// The table, and the parsed file that it is a part of; defined where TOML++ is known.
  struct Parsed;
  /// `name` is for messages: "[frame]"; empty for the whole file.
  TomlTable(std::shared_ptr<const Parsed> parsed, std::filesystem::path file, std::string name,
            const std::vector<std::string>& known);

  template <typename Node>
  [[nodiscard]] double checked(const Node& node, std::string_view key, NumberRange range) const;
  [[nodiscard]] std::string full_name(std::string_view key) const;
  /// As the header of a table in this one is written: "brdf.lobe".
  [[nodiscard]] std::string path_of(std::string_view key) const;

  std::shared_ptr<const Parsed> parsed_;
  std::filesystem::path file_;
  std::string name_;
};

/// What `read` makes of a key's value; what it found wrong becomes an error at the line of the key.
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
