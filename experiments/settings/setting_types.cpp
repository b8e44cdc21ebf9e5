// Readers of the types of settings: from an option's text, and from a key of an experiment's file.
#include "experiments/settings/setting_types.hpp"

#include <fmt/ranges.h>

#include <charconv>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "experiments/settings/known_methods.hpp"
#include "renderer/core/memory.hpp"
#include "renderer/core/toml_table.hpp"

namespace footprint::setting_types {
namespace {

constexpr double least_noise = 1e-6, most_noise = 1.0;
constexpr double smallest_exposure = 1e-30, largest_exposure = 1e30;
constexpr double largest_exact = 9007199254740992.0;  // 2^53: TOML's numbers are read as doubles

Error does_not_fit(std::string_view option, std::string_view text, std::string_view why, std::string hint) {
  return {ErrorKind::usage, std::string(option), fmt::format("`{}` {}", text, why), std::move(hint)};
}

// The whole of `text` as a number; empty if it is none or does not fit the type.
template <typename Number>
std::optional<Number> parse_whole_of(std::string_view text) {
  Number number{};
  const char* end = text.data() + text.size();
  const auto [stop, status] = std::from_chars(text.data(), end, number);
  if (status != std::errc{} || stop != end) return std::nullopt;
  return number;
}

// The parts of a text with commas between; one empty part of an empty text.
std::vector<std::string> parts_of(const std::string& text) {
  std::vector<std::string> parts;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t stop = std::min(text.find(',', start), text.size());
    parts.push_back(text.substr(start, stop - start));
    start = stop + 1;
  }
  return parts;
}

double parse_positive(std::string_view option, std::string_view text, double low, double high) {
  const std::string hint = fmt::format("give a number from {} to {}", low, high);
  const auto number = parse_whole_of<double>(text);
  if (!number || !std::isfinite(*number) || *number <= 0.0)
    throw does_not_fit(option, text, "is not a positive number", hint);
  if (*number < low || *number > high)
    throw does_not_fit(option, text, fmt::format("is not within {} to {}", low, high), hint);
  return *number;
}

double parse_angle(std::string_view option, std::string_view text, double most) {
  const auto number = parse_whole_of<double>(text);
  if (number && std::abs(*number) <= most && *number != 0.0) return *number;
  throw does_not_fit(option, text, "is not a valid angle", fmt::format("give degrees from -{0} to {0}, not 0", most));
}

glm::dvec3 parse_direction(std::string_view option, const std::string& text) {
  std::vector<double> values;
  for (const std::string& part : parts_of(text)) {
    if (const auto number = parse_whole_of<double>(part); number && std::isfinite(*number)) values.push_back(*number);
  }
  const glm::dvec3 direction =
      values.size() == 3 && parts_of(text).size() == 3 ? glm::dvec3(values[0], values[1], values[2]) : glm::dvec3(0);
  const double length = glm::length(direction);
  if (length > 0.0 && std::isfinite(length)) return direction / length;
  throw does_not_fit(option, text, "is not a direction", "give X,Y,Z in the world, for example 0,1,0");
}

int parse_side(std::string_view option, std::string_view size, std::string_view digits) {
  const std::string hint = "give WIDTHxHEIGHT in pixels, for example 512x512";
  const bool is_count = !digits.empty() && digits.find_first_not_of("0123456789") == std::string_view::npos;
  if (!is_count) throw does_not_fit(option, size, "is not a frame size", hint);
  // Digits that do not fit the type are a number all the same, and far over the limit.
  const auto side = parse_whole_of<std::uint64_t>(digits).value_or(std::numeric_limits<std::uint64_t>::max());
  if (side == 0) throw does_not_fit(option, size, "has no pixels", hint);
  if (side > max_frame_side)
    throw does_not_fit(option, size, fmt::format("has a side of more than {} pixels", max_frame_side), hint);
  return static_cast<int>(side);
}

glm::ivec2 parse_size(std::string_view option, std::string_view text) {
  const std::size_t cross = std::min(text.find('x'), text.size());
  const std::string_view height = cross < text.size() ? text.substr(cross + 1) : std::string_view();
  return {parse_side(option, text, text.substr(0, cross)), parse_side(option, text, height)};
}

std::vector<double> parse_distances(std::string_view option, const std::string& text, std::size_t most) {
  std::vector<double> distances;
  for (const std::string& part : parts_of(text)) {
    const double distance = parse_positive(option, part, smallest_distance, largest_distance);
    if (std::ranges::find(distances, distance) != distances.end())
      throw does_not_fit(option, part, "is given twice", "give each once");
    distances.push_back(distance);
  }
  if (distances.size() > most) throw does_not_fit(option, text, "is more than one distance", "give one");
  return distances;
}

std::vector<double> read_distances(const TomlTable& table, std::string_view key) {
  std::vector<double> distances = table.numbers(key, 0, {smallest_distance, largest_distance}).value();
  for (const double distance : distances) {
    if (std::ranges::count(distances, distance) > 1)
      throw table.error_at(key, fmt::format("contains {:g} twice", distance), "give each once");
  }
  return distances;
}

std::optional<Exposure> parse_exposure(std::string_view option, std::string_view text) {
  if (text == "auto") return std::nullopt;
  const auto factor = parse_whole_of<double>(text);
  if (!factor || !(*factor >= smallest_exposure && *factor <= largest_exposure))
    throw does_not_fit(option, text, "is not an exposure", "give `auto` or a positive factor on radiance");
  return Exposure{.factor = static_cast<float>(*factor), .source = ExposureSource::command_line};
}

std::optional<Exposure> read_exposure(const TomlTable& table, std::string_view key) {
  if (table.is_word(key)) return at_key(table, key, [&] { return parse_exposure("", *table.word(key)); });
  const double factor = *table.number(key, {smallest_exposure, largest_exposure});
  return Exposure{.factor = static_cast<float>(factor), .source = ExposureSource::experiment};
}

MethodSpec parse_one_method(std::string_view option, const std::string& text) {
  if (text == "reference") return {.text = text, .name = text, .options = {}};
  const std::vector<MethodSpec> methods = parse_known_methods(text);
  if (methods.size() == 1) return methods.front();
  throw does_not_fit(option, text, "is more than one method", "name one");
}

std::vector<MethodSpec> read_methods(const TomlTable& table, std::string_view key) {
  if (table.is_word(key)) {
    if (*table.word(key) == "all") return every_method();
    throw table.error_at(key, "must be a list of strings, or \"all\"", R"(write it as ["direct", "toksvig"])");
  }
  const std::vector<std::string> words = *table.words(key);
  for (const std::string& word : words) {
    if (word.find(',') != std::string::npos)
      throw table.error_at(key, fmt::format("has `{:.80}`", word), "write each method on its own");
  }
  return at_key(table, key, [&] { return parse_known_methods(fmt::format("{}", fmt::join(words, ","))); });
}

EffectSet effects_called(const std::vector<std::string>& words, std::string_view place) {
  const std::vector<std::string> names = effect_names(EffectSet{}.set());
  EffectSet effects;
  for (const std::string& word : words) effects.set(find_word(names, word, "effect", place));
  return effects;
}

std::vector<int> read_whole_numbers(const TomlTable& table, std::string_view key, std::size_t count,
                                    NumberRange range) {
  const std::vector<double> values = table.numbers(key, count, range).value();
  std::vector<int> numbers;
  for (const double value : values) {
    if (value != std::floor(value)) throw table.error_at(key, fmt::format("has {:g}", value), "give whole numbers");
    numbers.push_back(static_cast<int>(value));
  }
  return numbers;
}

template <class Number>
SettingType whole_number_of(Field<Number> field, Number low, Number high) {
  const std::string takes =
      high == std::numeric_limits<Number>::max() ? fmt::format("{} or more", low) : fmt::format("{} to {}", low, high);
  const NumberRange range{static_cast<double>(low), std::min(static_cast<double>(high), largest_exact)};
  const auto parse = [=](RunSettings& run, std::string_view option, const std::string& text) {
    const auto number = parse_whole_of<Number>(text);
    if (!number || *number < low || *number > high)
      throw does_not_fit(option, text, "is not valid", fmt::format("give a whole number, {}", takes));
    field(run) = *number;
  };
  return {.word = "N",
          .option_takes = takes,
          .file_takes = takes,
          .read_text = parse,
          .read_file = [=](RunSettings& run, const TomlTable& table,
                           std::string_view key) { field(run) = static_cast<Number>(*table.whole_number(key, range)); },
          .text = [=](RunSettings run) { return fmt::format("{}", field(run)); }};
}

}  // namespace

SettingType any_text(Field<std::string> field, const char* word) {
  return {.word = word,
          .option_takes = {},
          .file_takes = {},
          .read_text = [=](RunSettings& run, std::string_view, const std::string& text) { field(run) = text; },
          .read_file =
              [=](RunSettings& run, const TomlTable& table, std::string_view key) {
                field(run) = *table.word(key);
                if (field(run).empty()) throw table.error_at(key, "is empty", "fill it in");
              },
          .text = [=](RunSettings run) { return field(run); }};
}

SettingType any_name(Field<std::optional<std::string>> field, const char* word) {
  return {.word = word,
          .option_takes = {},
          .file_takes = {},
          .read_text =
              [=](RunSettings& run, std::string_view option, const std::string& text) {
                if (text.empty()) throw does_not_fit(option, text, "is empty", "give a name, or a number from 0");
                field(run) = text;
              },
          .read_file = nullptr,
          .text = [=](RunSettings run) { return field(run).value_or(""); }};
}

SettingType file_path(Field<std::optional<std::filesystem::path>> field) {
  return {.word = "FILE",
          .option_takes = {},
          .file_takes = {},
          .read_text =
              [=](RunSettings& run, std::string_view option, const std::string& text) {
                if (text.empty()) throw does_not_fit(option, text, "is empty", "name a file");
                field(run) = text;
              },
          .read_file = nullptr,
          .text = [=](RunSettings run) { return field(run) ? field(run)->string() : std::string(); }};
}

SettingType whole_number(Field<int> field, int low, int high) { return whole_number_of(field, low, high); }

SettingType whole_number(Field<std::uint64_t> field, std::uint64_t low, std::uint64_t high) {
  return whole_number_of(field, low, high);
}

SettingType whole_numbers(Field<std::vector<int>> field, int low, int high) {
  return {
      .word = "LIST",
      .option_takes = {},
      .file_takes = fmt::format("a list, each {} to {}", low, high),
      .read_text = nullptr,
      .read_file =
          [=](RunSettings& run, const TomlTable& table, std::string_view key) {
            field(run) = read_whole_numbers(table, key, 0, {static_cast<double>(low), static_cast<double>(high)});
          },
      .text =
          [=](RunSettings run) { return field(run).empty() ? "" : fmt::format("[{}]", fmt::join(field(run), ", ")); }};
}

SettingType positive_number(Field<std::optional<double>> field, double low, double high) {
  const std::string takes = fmt::format("{} to {}", low, high);
  return {.word = "X",
          .option_takes = takes,
          .file_takes = takes,
          .read_text = [=](RunSettings& run, std::string_view option,
                           const std::string& text) { field(run) = parse_positive(option, text, low, high); },
          .read_file =
              [=](RunSettings& run, const TomlTable& table, std::string_view key) {
                field(run) = *table.number(key, {low, high});
              },
          .text = [=](RunSettings run) { return field(run) ? fmt::format("{}", *field(run)) : ""; }};
}

SettingType angle(Field<std::optional<double>> field, double most) {
  return {.word = "DEGREES",
          .option_takes = fmt::format("-{0} to {0}", most),
          .file_takes = {},
          .read_text = [=](RunSettings& run, std::string_view option,
                           const std::string& text) { field(run) = parse_angle(option, text, most); },
          .read_file = nullptr,
          .text = [=](RunSettings run) { return field(run) ? fmt::format("{}", *field(run)) : ""; }};
}

SettingType direction(Field<std::optional<glm::dvec3>> field) {
  return {.word = "X,Y,Z",
          .option_takes = {},
          .file_takes = {},
          .read_text = [=](RunSettings& run, std::string_view option,
                           const std::string& text) { field(run) = parse_direction(option, text); },
          .read_file = nullptr,
          .text =
              [=](RunSettings run) {
                const std::optional<glm::dvec3>& axis = field(run);
                return axis ? fmt::format("{},{},{}", axis->x, axis->y, axis->z) : "";
              }};
}

SettingType fixed_samples(Field<ReferenceSettings> field, int low, int high) {
  const std::string takes = fmt::format("{} to {}", low, high);
  const NumberRange range{static_cast<double>(low), static_cast<double>(high)};
  const auto set = [=](RunSettings& run, int spp) {
    field(run).spp = spp;
    field(run).fixed_spp = true;
  };
  return {.word = "N",
          .option_takes = takes,
          .file_takes = takes,
          .read_text =
              [=](RunSettings& run, std::string_view option, const std::string& text) {
                const auto number = parse_whole_of<int>(text);
                if (!number || *number < low || *number > high)
                  throw does_not_fit(option, text, "is not valid", fmt::format("give a whole number, {}", takes));
                set(run, *number);
              },
          .read_file = [=](RunSettings& run, const TomlTable& table,
                           std::string_view key) { set(run, static_cast<int>(*table.whole_number(key, range))); },
          .text = [=](RunSettings run) { return fmt::format("{}", field(run).spp); }};
}

SettingType noise(Field<ReferenceSettings> field) {
  const std::string takes = fmt::format("{} to {}, or auto", least_noise, most_noise);
  const auto set = [=](RunSettings& run, std::optional<double> value) {
    field(run).by_noise = true;
    field(run).noise = value;
  };
  const auto parse = [=](RunSettings& run, std::string_view option, const std::string& text) {
    set(run, text == "auto" ? std::nullopt : std::optional(parse_positive(option, text, least_noise, most_noise)));
  };
  return {.word = "X",
          .option_takes = takes,
          .file_takes = takes,
          .read_text = parse,
          .read_file =
              [=](RunSettings& run, const TomlTable& table, std::string_view key) {
                if (table.is_word(key)) return at_key(table, key, [&] { parse(run, "", *table.word(key)); });
                set(run, *table.number(key, {least_noise, most_noise}));
              },
          .text =
              [=](RunSettings run) {
                if (!field(run).by_noise) return std::string();
                return field(run).noise ? fmt::format("{}", *field(run).noise) : std::string("auto");
              }};
}

SettingType distances(Field<std::vector<double>> field, std::size_t most) {
  const std::string range = fmt::format("{} to {}", smallest_distance, largest_distance);
  return {.word = most == 1 ? "X" : "LIST",
          .option_takes = most == 1 ? range : range + " each, comma-separated",
          .file_takes = "a list, each " + range,
          .read_text = [=](RunSettings& run, std::string_view option,
                           const std::string& text) { field(run) = parse_distances(option, text, most); },
          .read_file = [=](RunSettings& run, const TomlTable& table,
                           std::string_view key) { field(run) = read_distances(table, key); },
          .text = [=](RunSettings run) { return fmt::format("{}", fmt::join(field(run), ",")); }};
}

SettingType frame_size(Field<std::optional<glm::ivec2>> field) {
  const auto parse = [=](RunSettings& run, std::string_view option, const std::string& text) {
    const glm::ivec2 size = parse_size(option, text);
    constexpr std::uint64_t pixel_bytes = 4 * sizeof(float);
    require_memory(frame_bytes(static_cast<std::uint64_t>(size.x), static_cast<std::uint64_t>(size.y), pixel_bytes),
                   fmt::format("an image of {}x{}", size.x, size.y));
    field(run) = size;
  };
  return {
      .word = "WIDTHxHEIGHT",
      .option_takes = fmt::format("1 to {} per side, as memory permits", max_frame_side),
      .file_takes = fmt::format("[width, height] or \"WIDTHxHEIGHT\", 1 to {} each", max_frame_side),
      .read_text = parse,
      .read_file =
          [=](RunSettings& run, const TomlTable& table, std::string_view key) {
            if (table.is_word(key)) return at_key(table, key, [&] { parse(run, "", *table.word(key)); });
            const std::vector<int> sides = read_whole_numbers(table, key, 2, {1, max_frame_side});
            field(run) = glm::ivec2(sides[0], sides[1]);
          },
      .text = [=](RunSettings run) { return field(run) ? fmt::format("{}x{}", field(run)->x, field(run)->y) : ""; }};
}

SettingType exposure(Field<std::optional<Exposure>> field) {
  const std::string takes = "above 0, or auto";
  return {.word = "X",
          .option_takes = takes,
          .file_takes = takes,
          .read_text = [=](RunSettings& run, std::string_view option,
                           const std::string& text) { field(run) = parse_exposure(option, text); },
          .read_file = [=](RunSettings& run, const TomlTable& table,
                           std::string_view key) { field(run) = read_exposure(table, key); },
          .text = [=](RunSettings run) { return field(run) ? fmt::format("{}", field(run)->factor) : "auto"; }};
}

SettingType footprint_filter(Field<std::optional<FootprintFilter>> field) {
  const std::string takes = footprint_filter_choices();
  return {.word = "FILTER",
          .option_takes = takes,
          .file_takes = takes,
          .read_text = [=](RunSettings& run, std::string_view option,
                           const std::string& text) { field(run) = parse_footprint_filter(text, option); },
          .read_file =
              [=](RunSettings& run, const TomlTable& table, std::string_view key) {
                field(run) = at_key(table, key, [&] { return parse_footprint_filter(*table.word(key), ""); });
              },
          .text = [=](RunSettings run) { return field(run) ? footprint_filter_text(*field(run)) : ""; }};
}

SettingType one_method(Field<std::vector<MethodSpec>> field) {
  return {.word = "M",
          .option_takes = "name or name:option=value",
          .file_takes = {},
          .read_text = [=](RunSettings& run, std::string_view option,
                           const std::string& text) { field(run) = {parse_one_method(option, text)}; },
          .read_file = nullptr,
          .text = methods(field).text};
}

SettingType methods(Field<std::vector<MethodSpec>> field) {
  return {.word = "LIST",
          .option_takes = "name or name:option=value each, comma-separated",
          .file_takes =
              R"(a list as ["direct", "toksvig:storage=fp16"], or "all" for all but slow ones with their defaults)",
          .read_text = [=](RunSettings& run, std::string_view,
                           const std::string& text) { field(run) = parse_known_methods(text); },
          .read_file = [=](RunSettings& run, const TomlTable& table,
                           std::string_view key) { field(run) = read_methods(table, key); },
          .text = [=](RunSettings run) { return fmt::format("{}", fmt::join(texts_of(field(run)), ",")); }};
}

SettingType effects(Field<EffectSet> field) {
  return {.word = "LIST",
          .option_takes = "as cast_shadow,fresnel",
          .file_takes = R"(a list as ["cast_shadow"])",
          .read_text = [=](RunSettings& run, std::string_view option,
                           const std::string& text) { field(run) = effects_called(parts_of(text), option); },
          .read_file =
              [=](RunSettings& run, const TomlTable& table, std::string_view key) {
                field(run) = at_key(table, key, [&] { return effects_called(*table.words(key), ""); });
              },
          .text = [=](RunSettings run) { return fmt::format("{}", fmt::join(effect_names(field(run)), ",")); }};
}

SettingType no_folder(Field<std::optional<std::filesystem::path>> field) {
  return {.word = {},
          .option_takes = {},
          .file_takes = {},
          .read_text = [=](RunSettings& run, std::string_view, const std::string&) { field(run).reset(); },
          .read_file = nullptr,
          .text = [](const RunSettings&) { return std::string(); }};
}

std::size_t word_of_key(const TomlTable& table, std::string_view key, const std::vector<std::string>& words) {
  return *table.choice(key, words);
}

}  // namespace footprint::setting_types
