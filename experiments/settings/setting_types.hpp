// The types of a run's settings, for their table alone: the values that each takes, and the field that the value goes
// to.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "experiments/settings/setting.hpp"
#include "renderer/core/gpu_chips.hpp"
#include "renderer/core/memory.hpp"
#include "renderer/core/numbers.hpp"

namespace footprint::setting_types {

/// The largest side of a frame size, in pixels; memory may limit it further.
inline constexpr int max_frame_side = 10'000'000;

/// The type of the value that a field stores. A field is a function of a run's settings that returns a reference to it.
template <class Field>
using ValueOf = std::remove_reference_t<std::invoke_result_t<Field, RunSettings&>>;

/// Reads comma-separated methods, and checks them; files are relative to `folder`.
using MethodParser = std::vector<MethodSpec> (*)(const std::string& text, const std::filesystem::path& folder);

inline constexpr double least_noise = 1e-6, most_noise = 1.0;
inline constexpr double smallest_exposure = 1e-30, largest_exposure = 1e30;

inline Error not_valid(std::string_view option, const SettingInput& input, std::string_view why, std::string hint) {
  return {ErrorKind::usage, std::string(option), fmt::format("`{}` {}", input.text(), why), std::move(hint)};
}

template <typename Number>
std::string range_text(Number low, Number high) {
  return high == std::numeric_limits<Number>::max() ? fmt::format("{} or more", low)
                                                    : fmt::format("{} to {}", low, high);
}

template <typename Number>
Number parse_whole_number(Number low, Number high, std::string_view option, const SettingInput& input) {
  const std::optional<Number> number = input.whole<Number>();
  if (number && *number >= low && *number <= high) return *number;
  throw not_valid(option, input, "is not valid", fmt::format("give a whole number, {}", range_text(low, high)));
}

inline double parse_positive(double low, double high, std::string_view option, const SettingInput& input) {
  const std::string hint = fmt::format("give a number from {} to {}", low, high);
  const std::optional<double> number = input.number();
  if (!number || *number <= 0.0) throw not_valid(option, input, "is not a positive number", hint);
  if (*number < low || *number > high)
    throw not_valid(option, input, fmt::format("is not within {} to {}", low, high), hint);
  return *number;
}

inline glm::dvec3 parse_direction(std::string_view option, const SettingInput& input) {
  const std::vector<SettingInput> parts = input.parts();
  std::vector<double> values;
  for (const SettingInput& part : parts) {
    if (const std::optional<double> number = part.number()) values.push_back(*number);
  }
  const glm::dvec3 direction =
      values.size() == 3 && parts.size() == 3 ? glm::dvec3(values[0], values[1], values[2]) : glm::dvec3(0);
  const double length = glm::length(direction);
  if (length > 0.0 && std::isfinite(length)) return direction / length;
  throw not_valid(option, input, "is not a direction", "give X,Y,Z in the world, for example 0,1,0");
}

inline std::string joined_texts(const std::vector<SettingInput>& parts, std::string_view separator) {
  std::vector<std::string> texts;
  texts.reserve(parts.size());
  for (const SettingInput& part : parts) texts.push_back(part.text());
  return fmt::format("{}", fmt::join(texts, separator));
}

// The side of a size, which errors name whole. Digits that do not fit the type are a number too, far over the limit.
inline int parse_side(std::string_view option, const std::string& size, const SettingInput& side) {
  const std::string hint = "give WIDTHxHEIGHT in pixels, for example 512x512", text = side.text();
  const bool is_count = !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
  if (!is_count) throw not_valid(option, size, "is not a frame size", hint);
  const auto pixels = side.whole<std::uint64_t>().value_or(std::numeric_limits<std::uint64_t>::max());
  if (pixels == 0) throw not_valid(option, size, "has no pixels", hint);
  if (pixels > max_frame_side)
    throw not_valid(option, size, fmt::format("has a side of more than {} pixels", max_frame_side), hint);
  return static_cast<int>(pixels);
}

inline glm::ivec2 parse_size(std::string_view option, const SettingInput& input) {
  std::vector<SettingInput> sides = input.parts('x');
  const std::string text = joined_texts(sides, "x");
  if (sides.size() != 2) sides.assign(2, "");  // not a size
  const glm::ivec2 size{parse_side(option, text, sides[0]), parse_side(option, text, sides[1])};
  if (option.empty()) return size;  // an experiment may be listed and checked on a machine that is too small to run it
  constexpr std::uint64_t pixel_bytes = 4 * sizeof(float);
  require_memory(frame_bytes(static_cast<std::uint64_t>(size.x), static_cast<std::uint64_t>(size.y), pixel_bytes),
                 fmt::format("an image of {}x{}", size.x, size.y));
  return size;
}

inline std::vector<double> parse_distances(std::size_t most, std::string_view option, const SettingInput& input) {
  std::vector<double> distances;
  for (const SettingInput& part : input.parts()) {
    const double distance = parse_positive(smallest_distance, largest_distance, option, part);
    if (std::ranges::find(distances, distance) != distances.end())
      throw not_valid(option, part, "is given twice", "give each once");
    distances.push_back(distance);
  }
  if (distances.size() > most) throw not_valid(option, input, "is more than one distance", "give one");
  return distances;
}

inline std::optional<Exposure> parse_exposure(std::string_view option, const SettingInput& input) {
  if (input.text() == "auto") return std::nullopt;
  const std::optional<double> factor = input.number();
  if (!factor || !(*factor >= smallest_exposure && *factor <= largest_exposure))
    throw not_valid(option, input, "is not an exposure", "give `auto` or a positive factor on radiance");
  return Exposure{.factor = static_cast<float>(*factor),
                  .source = option.empty() ? ExposureSource::experiment : ExposureSource::command_line};
}

inline MethodSpec parse_one_method(std::string_view option, const SettingInput& input,
                                   const std::filesystem::path& folder, MethodParser parse) {
  const std::string text = input.text();
  if (text == "reference") return {.text = text, .name = text, .options = {}};
  const std::vector<MethodSpec> methods = parse(text, folder);
  if (methods.size() == 1) return methods.front();
  throw not_valid(option, text, "is more than one method", "name one");
}

inline std::string parse_name(const char* hint, std::string_view option, const SettingInput& input) {
  std::string text = input.text();
  if (text.empty()) throw not_valid(option, text, "is empty", hint);
  return text;
}

// A value as a text: none of a value that is missing.
template <class Value>
std::string written(const Value& value) {
  if constexpr (requires { value.has_value(); }) {
    return value ? written(*value) : std::string();
  } else if constexpr (std::is_same_v<Value, std::filesystem::path>) {
    return value.string();
  } else {
    return fmt::format("{}", value);
  }
}

// A value of which `parse(option, input)` makes what the field stores.
SettingType typed(auto field, std::string word, std::string takes, auto parse, auto write) {
  return {.word = std::move(word),
          .takes = std::move(takes),
          .read = [=](RunSettings& run, std::string_view option,
                      const SettingInput& input) { field(run) = parse(option, input); },
          .text = [=](RunSettings run) { return std::string(write(field(run))); }};
}

template <class Field>
SettingType typed(Field field, std::string word, std::string takes, auto parse) {
  return typed(field, std::move(word), std::move(takes), parse, written<ValueOf<Field>>);
}

// The type for a value that is a list in a file, whose parts `separator` joins in a text.
inline SettingType listed(SettingType type, std::string file_takes, char separator = ',') {
  type.file_takes = std::move(file_takes);
  type.separator = separator;
  return type;
}

inline const auto joined = [](const auto& values) { return fmt::format("{}", fmt::join(values, ",")); };

/// Any text.
[[nodiscard]] SettingType any_text(auto field, const char* word) {
  return typed(field, word, "", [](std::string_view, const SettingInput& input) { return input.text(); });
}

/// Any text except an empty one.
[[nodiscard]] SettingType any_name(auto field, const char* word) {
  return typed(field, word, "", std::bind_front(parse_name, "give a name, or a number from 0"));
}

/// A file's path.
[[nodiscard]] SettingType file_path(auto field) {
  return typed(field, "FILE", "", std::bind_front(parse_name, "name a file"));
}

/// Folders, one for each time that the option is given.
[[nodiscard]] SettingType folders(auto field) {
  const auto parse = std::bind_front(parse_name, "name a folder");
  return {.word = "DIR",
          .read = [=](RunSettings& run, std::string_view option,
                      const SettingInput& input) { field(run).emplace_back(parse(option, input)); },
          .text = [](const RunSettings&) { return std::string(); },
          .repeats = true};
}

/// A whole number, both ends inclusive; the type's largest value as `high` means no limit.
template <class Field>
[[nodiscard]] SettingType whole_number(Field field, ValueOf<Field> low, ValueOf<Field> high) {
  return typed(field, "N", range_text(low, high), std::bind_front(parse_whole_number<ValueOf<Field>>, low, high));
}

/// A list of whole numbers, each within the range.
[[nodiscard]] SettingType whole_numbers(auto field, int low, int high) {
  const auto write = [](const auto& all) { return all.empty() ? "" : fmt::format("[{}]", fmt::join(all, ", ")); };
  const auto parse = [=](std::string_view option, const SettingInput& input) {
    std::vector<int> numbers;
    for (const SettingInput& part : input.parts()) numbers.push_back(parse_whole_number(low, high, option, part));
    return numbers;
  };
  return listed(typed(field, "LIST", "", parse, write), fmt::format("a list, each {} to {}", low, high));
}

/// A number above 0.
[[nodiscard]] SettingType positive_number(auto field, double low, double high) {
  return typed(field, "X", fmt::format("{} to {}", low, high), std::bind_front(parse_positive, low, high));
}

/// An angle in degrees, in either direction, not 0.
[[nodiscard]] SettingType angle(auto field, double most) {
  const auto parse = [=](std::string_view option, const SettingInput& input) {
    const std::optional<double> number = input.number();
    if (number && std::abs(*number) <= most && *number != 0.0) return *number;
    throw not_valid(option, input, "is not a valid angle", fmt::format("give degrees from -{0} to {0}, not 0", most));
  };
  return typed(field, "DEGREES", fmt::format("-{0} to {0}", most), parse);
}

/// A moment in seconds, of either sign.
[[nodiscard]] SettingType seconds(auto field) {
  const auto parse = [](std::string_view option, const SettingInput& input) {
    const std::optional<double> number = input.number();
    if (number && std::abs(*number) <= largest_seconds) return *number;
    throw not_valid(option, input, "is not a time", fmt::format("give seconds from -{0} to {0}", largest_seconds));
  };
  return typed(field, "SECONDS", fmt::format("-{0} to {0}", largest_seconds), parse);
}

/// A direction in world space, of any length except 0; stored as a unit vector.
[[nodiscard]] SettingType direction(auto field) {
  const auto write = [](const auto& axis) { return axis ? fmt::format("{},{},{}", axis->x, axis->y, axis->z) : ""; };
  return typed(field, "X,Y,Z", "", parse_direction, write);
}

/// A fixed number of samples per pixel.
[[nodiscard]] SettingType fixed_samples(auto field, int low, int high) {
  return {.word = "N",
          .takes = range_text(low, high),
          .read =
              [=](RunSettings& run, std::string_view option, const SettingInput& input) {
                field(run).spp = parse_whole_number(low, high, option, input);
                field(run).fixed_spp = true;
              },
          .text = [=](RunSettings run) { return fmt::format("{}", field(run).spp); }};
}

/// A target noise floor, or "auto".
[[nodiscard]] SettingType noise(auto field) {
  return {.word = "X",
          .takes = fmt::format("{} to {}, or auto", least_noise, most_noise),
          .read =
              [=](RunSettings& run, std::string_view option, const SettingInput& input) {
                field(run).by_noise = true;
                field(run).noise = input.text() == "auto"
                                       ? std::nullopt
                                       : std::optional(parse_positive(least_noise, most_noise, option, input));
              },
          .text =
              [=](RunSettings run) {
                if (!field(run).by_noise) return std::string();
                return field(run).noise ? fmt::format("{}", *field(run).noise) : std::string("auto");
              }};
}

/// Factors on the camera's distance, at most `most`, all different.
[[nodiscard]] SettingType distances(auto field, std::size_t most) {
  const std::string range = fmt::format("{} to {}", smallest_distance, largest_distance);
  const bool is_one = most == 1;
  return listed(typed(field, is_one ? "X" : "LIST", is_one ? range : range + " each, comma-separated",
                      std::bind_front(parse_distances, most), joined),
                "a list, each " + range);
}

/// A frame size. Errors (machine), for an option only: one image of it exceeds memory.
[[nodiscard]] SettingType frame_size(auto field) {
  const auto write = [](const auto& size) { return size ? fmt::format("{}x{}", size->x, size->y) : ""; };
  const std::string takes = fmt::format("1 to {} per side, as memory permits", max_frame_side);
  return listed(typed(field, "WIDTHxHEIGHT", takes, parse_size, write),
                fmt::format("[width, height] or \"WIDTHxHEIGHT\", 1 to {} each", max_frame_side), 'x');
}

/// A factor on radiance, or "auto" for none.
[[nodiscard]] SettingType exposure(auto field) {
  const auto write = [](const auto& exposure) { return exposure ? fmt::format("{}", exposure->factor) : "auto"; };
  return typed(field, "X", "above 0, or auto", parse_exposure, write);
}

/// A footprint filter.
[[nodiscard]] SettingType footprint_filter(auto field) {
  const auto write = [](const auto& filter) { return filter ? footprint_filter_text(*filter) : ""; };
  return typed(
      field, "FILTER", footprint_filter_choices(),
      [](std::string_view option, const SettingInput& input) { return parse_footprint_filter(input.text(), option); },
      write);
}

/// Methods; in a file also "all".
[[nodiscard]] SettingType methods(auto field, MethodParser parse = parse_known_methods) {
  return {.word = "LIST",
          .takes = "name, FILE.glsl or name:option=value each, comma-separated",
          .file_takes =
              R"(a list as ["direct", "toksvig:storage=fp16"], or "all" for all but slow ones with their defaults)",
          .read =
              [=](RunSettings& run, std::string_view option, const SettingInput& input) {
                const std::string text = input.text();
                const bool are_all = option.empty() && text == "all";  // in files
                field(run) = are_all ? every_method() : parse(text, run.method_folder);
              },
          .text = [=](RunSettings run) { return joined(texts_of(field(run))); },
          .separator = ','};
}

/// One method, or `reference`.
[[nodiscard]] SettingType one_method(auto field, MethodParser parse = parse_known_methods) {
  return {.word = "M",
          .takes = "name or FILE.glsl, or name:option=value",
          .read =
              [=](RunSettings& run, std::string_view option, const SettingInput& input) {
                field(run) = {parse_one_method(option, input, run.method_folder, parse)};
              },
          .text = methods(field).text};
}

/// A set of effects, by name.
[[nodiscard]] SettingType effects(auto field) {
  const auto parse = [](std::string_view option, const SettingInput& input) {
    const std::vector<std::string> names = effect_names(EffectSet{}.set());
    EffectSet effects;
    for (const SettingInput& word : input.parts()) effects.set(find_word(names, word.text(), "effect", option));
    return effects;
  };
  const auto write = [](const EffectSet& effects) { return joined(effect_names(effects)); };
  return listed(typed(field, "LIST", "as cast_shadow,fresnel", parse, write), R"(a list as ["cast_shadow"])");
}

/// GPUs whose cost is estimated, by name.
[[nodiscard]] SettingType gpus(auto field) {
  const std::string takes = fmt::format("{}, all", fmt::join(chip_names(), ", "));
  const auto parse = [](std::string_view option, const SettingInput& input) {
    std::vector<std::string> wanted, names;
    for (const SettingInput& part : input.parts()) wanted.push_back(part.text());
    for (const Chip* chip : chips_named(option, wanted)) names.emplace_back(chip->name);
    return names;
  };
  return listed(typed(field, "NAME,...", takes, parse, joined), R"(a list as ["Steam Deck", "RX 6800"], or ["all"])");
}

/// A flag that unsets a folder.
[[nodiscard]] SettingType no_folder(auto field) {
  return typed(
      field, "", "", [](std::string_view, const SettingInput&) { return std::nullopt; },
      [](const auto&) { return ""; });
}

/// A flag. An experiment's file writes true or false.
[[nodiscard]] SettingType flag(auto field) {
  SettingType type = typed(
      field, "", "",
      [](std::string_view, const SettingInput& input) { return input.boolean().value_or(input.text() == "true"); },
      [](bool is_set) { return is_set ? "true" : ""; });
  type.is_switch = true;
  return type;
}

/// One of some words; `what` names them in errors.
template <class Value, std::size_t count>
[[nodiscard]] SettingType one_word(auto field, const std::array<Word<Value>, count>& words, const char* what) {
  SettingType type = typed(
      field, "WORD", fmt::format("{}", fmt::join(word_names(words), ", ")),
      [=](std::string_view option, const SettingInput& input) {
        if constexpr (std::is_same_v<Value, bool>) {
          if (const std::optional<bool> is_on = input.boolean()) return *is_on;
        }
        return word_value(words, input.text(), what, option);
      },
      [=](const Value& value) { return word_for(words, value); });
  type.is_switch = std::is_same_v<Value, bool>;
  if (type.is_switch) type.file_takes = "true, false, " + type.takes;
  return type;
}

}  // namespace footprint::setting_types
