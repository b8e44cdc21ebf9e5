// Values of TOML tables that several readers share: paths, words, directions, colours and points.
#pragma once

#include <array>
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/core/names.hpp"
#include "renderer/core/toml_table.hpp"

namespace footprint {

inline constexpr NumberRange unit_range{0.0, 1.0};
inline constexpr NumberRange length_range{1e-6, 1e6};      ///< metres, above 0
inline constexpr NumberRange coordinate_range{-1e9, 1e9};  ///< metres

/// Assigns the value of a key; a missing key leaves `target` as it is.
template <class Target, class Value>
void assign(Target& target, const std::optional<Value>& value) {
  if (value) target = static_cast<Target>(*value);
}
template <class Target, class Value>
void assign(std::optional<Target>& target, const std::optional<Value>& value) {
  if (value) target = static_cast<Target>(*value);
}

/// The value of a word of `words`.
template <class Value, std::size_t count>
[[nodiscard]] std::optional<Value> read_word(const TomlTable& table, std::string_view key,
                                             const std::array<Word<Value>, count>& words) {
  const auto index = table.choice(key, word_names(words));
  return index ? std::optional(words.at(*index).value) : std::nullopt;
}

/// A path relative to `folder`.
[[nodiscard]] std::optional<std::filesystem::path> read_path(const TomlTable& table, std::string_view key,
                                                             const std::filesystem::path& folder);

/// Two numbers.
[[nodiscard]] std::optional<glm::dvec2> read_pair(const TomlTable& table, std::string_view key, NumberRange range);

/// Three numbers. The readers here return nothing if the key is missing, and throw as TomlTable.
[[nodiscard]] std::optional<glm::dvec3> read_vector(const TomlTable& table, std::string_view key, NumberRange range);

/// A colour, each channel 0 to 1.
[[nodiscard]] std::optional<glm::vec3> read_color(const TomlTable& table, std::string_view key);

/// A unit vector, normalised from any length but 0.
[[nodiscard]] std::optional<glm::dvec3> read_direction(const TomlTable& table, std::string_view key);

/// The paths under `file` or `files`, of which a table must have one, relative to `folder`.
/// hint: of the error if it has neither or both.
[[nodiscard]] std::vector<std::filesystem::path> read_candidates(const TomlTable& table,
                                                                 const std::filesystem::path& folder,
                                                                 const std::string& hint);

/// The error if none of `candidates` exists.
/// package: the Debian package to install; without one `check` is the hint.
[[nodiscard]] Error missing_candidates(std::span<const std::filesystem::path> candidates, const std::string& message,
                                       const std::string& package, const std::string& check);

/// Throws Error (usage): the table lacks a required key.
/// document: the one that explains the key.
[[noreturn]] void refuse_missing(const TomlTable& table, std::string_view key,
                                 std::string_view document = "docs/reference/scenes.md");

/// The value of a required key. Throws as refuse_missing.
template <class Value>
[[nodiscard]] Value required(const TomlTable& table, std::string_view key, std::optional<Value> value,
                             std::string_view document = "docs/reference/scenes.md") {
  if (!value) refuse_missing(table, key, document);
  return *std::move(value);
}

}  // namespace footprint
