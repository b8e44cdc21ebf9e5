// The types of a run's settings: what each takes as an option's text and as a key's value, and where that goes.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "experiments/settings/setting.hpp"

namespace footprint::setting_types {

/// The most pixels a side that a frame size may name; what memory holds is asked later, by whoever takes it.
inline constexpr int max_frame_side = 10'000'000;

/// Where in a run's settings a value is kept.
template <class Value>
using Field = Value& (*)(RunSettings& run);

/// Any text.
[[nodiscard]] SettingType any_text(Field<std::string> field, const char* word);

/// Any text but an empty one, where it is given.
[[nodiscard]] SettingType any_name(Field<std::optional<std::string>> field, const char* word);

/// A file's path.
[[nodiscard]] SettingType file_path(Field<std::optional<std::filesystem::path>> field);

/// A whole number, both ends inclusive; a `high` that is the type's own counts as none.
[[nodiscard]] SettingType whole_number(Field<int> field, int low, int high);
[[nodiscard]] SettingType whole_number(Field<std::uint64_t> field, std::uint64_t low, std::uint64_t high);

/// Whole numbers of one range, in files alone.
[[nodiscard]] SettingType whole_numbers(Field<std::vector<int>> field, int low, int high);

/// A number above 0.
[[nodiscard]] SettingType positive_number(Field<std::optional<double>> field, double low, double high);

/// An angle in degrees, either way round.
[[nodiscard]] SettingType angle(Field<std::optional<double>> field, double most);

/// A direction of the world, of any length but 0; it is kept as a unit vector.
[[nodiscard]] SettingType direction(Field<std::optional<glm::dvec3>> field);

/// Samples a pixel, which then are fixed.
[[nodiscard]] SettingType fixed_samples(Field<ReferenceSettings> field, int low, int high);

/// A noise floor to be reached, or "auto".
[[nodiscard]] SettingType noise(Field<ReferenceSettings> field);

/// Factors on the camera's distance, `most` at most, none twice.
[[nodiscard]] SettingType distances(Field<std::vector<double>> field, std::size_t most);

/// A frame size. An option's also asks whether memory holds one picture of it: Errors (machine).
[[nodiscard]] SettingType frame_size(Field<std::optional<glm::ivec2>> field);

/// A factor on radiance, or "auto" for none.
[[nodiscard]] SettingType exposure(Field<std::optional<Exposure>> field);

/// A footprint filter.
[[nodiscard]] SettingType footprint_filter(Field<std::optional<FootprintFilter>> field);

/// One method, or `reference`; an option alone.
[[nodiscard]] SettingType one_method(Field<std::vector<MethodSpec>> field);

/// Methods, or "all" in a file.
[[nodiscard]] SettingType methods(Field<std::vector<MethodSpec>> field);

/// Effects by their names.
[[nodiscard]] SettingType effects(Field<EffectSet> field);

/// A flag that empties a folder's value.
[[nodiscard]] SettingType no_folder(Field<std::optional<std::filesystem::path>> field);

/// The index among `words` of the word that a key has. Errors (usage) name file, line and key.
[[nodiscard]] std::size_t word_of_key(const TomlTable& table, std::string_view key,
                                      const std::vector<std::string>& words);

/// One of some words; `what` it is in errors.
template <class Value, std::size_t count>
[[nodiscard]] SettingType one_word(std::type_identity_t<Field<Value>> field,
                                   const std::array<Word<Value>, count>& words, const char* what) {
  const std::vector<std::string> names = word_names(words);
  const std::string takes = fmt::format("{}", fmt::join(names, ", "));
  return {.word = "WORD",
          .option_takes = takes,
          .file_takes = takes,
          .read_text = [=](RunSettings& run, std::string_view option,
                           const std::string& text) { field(run) = word_value(words, text, what, option); },
          .read_file = [=](RunSettings& run, const TomlTable& table,
                           std::string_view key) { field(run) = words[word_of_key(table, key, names)].value; },
          .text = [=](RunSettings run) { return std::string(word_for(words, field(run))); }};
}

}  // namespace footprint::setting_types
