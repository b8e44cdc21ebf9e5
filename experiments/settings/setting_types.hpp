// The types of a run's settings: the texts that each takes, and the field that the value goes to.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "experiments/settings/known_methods.hpp"
#include "experiments/settings/setting.hpp"

namespace footprint::setting_types {

/// The largest side of a frame size, in pixels; memory may limit it further.
inline constexpr int max_frame_side = 10'000'000;

/// The field of a run's settings that stores a value.
template <class Value>
using Field = Value& (*)(RunSettings& run);

/// Any text.
[[nodiscard]] SettingType any_text(Field<std::string> field, const char* word);

/// Any text except an empty one.
[[nodiscard]] SettingType any_name(Field<std::optional<std::string>> field, const char* word);

/// A file's path.
[[nodiscard]] SettingType file_path(Field<std::optional<std::filesystem::path>> field);

/// A whole number, both ends inclusive; the type's largest value as `high` means no limit.
[[nodiscard]] SettingType whole_number(Field<int> field, int low, int high);
[[nodiscard]] SettingType whole_number(Field<std::uint64_t> field, std::uint64_t low, std::uint64_t high);

/// A list of whole numbers, each within the range.
[[nodiscard]] SettingType whole_numbers(Field<std::vector<int>> field, int low, int high);

/// A number above 0.
[[nodiscard]] SettingType positive_number(Field<std::optional<double>> field, double low, double high);
[[nodiscard]] SettingType positive_number(Field<double> field, double low, double high);

/// A moment in seconds, of either sign.
[[nodiscard]] SettingType seconds(Field<std::optional<double>> field);

/// An angle in degrees, in either direction, not 0.
[[nodiscard]] SettingType angle(Field<std::optional<double>> field, double most);

/// A direction in world space, of any length except 0; stored as a unit vector.
[[nodiscard]] SettingType direction(Field<std::optional<glm::dvec3>> field);

/// A fixed number of samples per pixel.
[[nodiscard]] SettingType fixed_samples(Field<ReferenceSettings> field, int low, int high);

/// A target noise floor, or "auto".
[[nodiscard]] SettingType noise(Field<ReferenceSettings> field);

/// Factors on the camera's distance, at most `most`, all different.
[[nodiscard]] SettingType distances(Field<std::vector<double>> field, std::size_t most);

/// A frame size. Errors (machine), for an option only: one image of it exceeds memory.
[[nodiscard]] SettingType frame_size(Field<std::optional<glm::ivec2>> field);

/// A factor on radiance, or "auto" for none.
[[nodiscard]] SettingType exposure(Field<std::optional<Exposure>> field);

/// A footprint filter.
[[nodiscard]] SettingType footprint_filter(Field<std::optional<FootprintFilter>> field);

/// Reads comma-separated methods, and checks them; files are relative to `folder`.
using MethodParser = std::vector<MethodSpec> (*)(const std::string& text, const std::filesystem::path& folder);

/// One method, or `reference`.
[[nodiscard]] SettingType one_method(Field<std::vector<MethodSpec>> field, MethodParser parse = parse_known_methods);

/// Methods; in a file also "all".
[[nodiscard]] SettingType methods(Field<std::vector<MethodSpec>> field, MethodParser parse = parse_known_methods);

/// A set of effects, by name.
[[nodiscard]] SettingType effects(Field<EffectSet> field);

/// GPUs whose cost is estimated, by name.
[[nodiscard]] SettingType gpus(Field<std::vector<std::string>> field);

/// A flag that unsets a folder.
[[nodiscard]] SettingType no_folder(Field<std::optional<std::filesystem::path>> field);

/// One of some words; `what` names them in errors.
template <class Value, std::size_t count>
[[nodiscard]] SettingType one_word(std::type_identity_t<Field<Value>> field,
                                   const std::array<Word<Value>, count>& words, const char* what) {
  return {.word = "WORD",
          .takes = fmt::format("{}", fmt::join(word_names(words), ", ")),
          .read_text = [=](RunSettings& run, std::string_view option,
                           const std::string& text) { field(run) = word_value(words, text, what, option); },
          .text = [=](RunSettings run) { return std::string(word_for(words, field(run))); }};
}

}  // namespace footprint::setting_types
