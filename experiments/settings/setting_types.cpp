// Reads the values of settings from text, and writes them as text.
#include "experiments/settings/setting_types.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "renderer/core/memory.hpp"
#include "renderer/core/numbers.hpp"
#include "renderer/gpu_cost/estimate.hpp"

namespace footprint::setting_types {
namespace {

constexpr double least_noise = 1e-6, most_noise = 1.0;
constexpr double smallest_exposure = 1e-30, largest_exposure = 1e30;

Error not_valid(std::string_view option, std::string_view text, std::string_view why, std::string hint) {
  return {ErrorKind::usage, std::string(option), fmt::format("`{}` {}", text, why), std::move(hint)};
}

// The comma-separated parts of a text; one empty part of an empty text.
std::vector<std::string> parts_of(const std::string& text) {
  std::vector<std::string> parts;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t stop = std::min(text.find(',', start), text.size());
    parts.push_back(text.substr(start, stop - start));
    start = stop + 1;
  }
  return parts;
}

template <typename Number>
std::string range_text(Number low, Number high) {
  return high == std::numeric_limits<Number>::max() ? fmt::format("{} or more", low)
                                                    : fmt::format("{} to {}", low, high);
}

template <typename Number>
Number parse_whole_number(std::string_view option, std::string_view text, Number low, Number high) {
  const auto number = parse_whole_of<Number>(text);
  if (number && *number >= low && *number <= high) return *number;
  throw not_valid(option, text, "is not valid", fmt::format("give a whole number, {}", range_text(low, high)));
}

double parse_positive(std::string_view option, std::string_view text, double low, double high) {
  const std::string hint = fmt::format("give a number from {} to {}", low, high);
  const auto number = parse_whole_of<double>(text);
  if (!number || !std::isfinite(*number) || *number <= 0.0)
    throw not_valid(option, text, "is not a positive number", hint);
  if (*number < low || *number > high)
    throw not_valid(option, text, fmt::format("is not within {} to {}", low, high), hint);
  return *number;
}

double parse_angle(std::string_view option, std::string_view text, double most) {
  const auto number = parse_whole_of<double>(text);
  if (number && std::abs(*number) <= most && *number != 0.0) return *number;
  throw not_valid(option, text, "is not a valid angle", fmt::format("give degrees from -{0} to {0}, not 0", most));
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
  throw not_valid(option, text, "is not a direction", "give X,Y,Z in the world, for example 0,1,0");
}

int parse_side(std::string_view option, std::string_view size, std::string_view digits) {
  const std::string hint = "give WIDTHxHEIGHT in pixels, for example 512x512";
  const bool is_count = !digits.empty() && digits.find_first_not_of("0123456789") == std::string_view::npos;
  if (!is_count) throw not_valid(option, size, "is not a frame size", hint);
  // Digits that do not fit the type are a number too, far over the limit.
  const auto side = parse_whole_of<std::uint64_t>(digits).value_or(std::numeric_limits<std::uint64_t>::max());
  if (side == 0) throw not_valid(option, size, "has no pixels", hint);
  if (side > max_frame_side)
    throw not_valid(option, size, fmt::format("has a side of more than {} pixels", max_frame_side), hint);
  return static_cast<int>(side);
}

glm::ivec2 parse_size(std::string_view option, std::string_view text) {
  const std::size_t cross = std::min(text.find('x'), text.size());
  const std::string_view height = cross < text.size() ? text.substr(cross + 1) : std::string_view();
  const glm::ivec2 size{parse_side(option, text, text.substr(0, cross)), parse_side(option, text, height)};
  if (option.empty()) return size;  // an experiment may be listed and checked on a machine that is too small to run it
  constexpr std::uint64_t pixel_bytes = 4 * sizeof(float);
  require_memory(frame_bytes(static_cast<std::uint64_t>(size.x), static_cast<std::uint64_t>(size.y), pixel_bytes),
                 fmt::format("an image of {}x{}", size.x, size.y));
  return size;
}

std::vector<double> parse_distances(std::string_view option, const std::string& text, std::size_t most) {
  std::vector<double> distances;
  for (const std::string& part : parts_of(text)) {
    const double distance = parse_positive(option, part, smallest_distance, largest_distance);
    if (std::ranges::find(distances, distance) != distances.end())
      throw not_valid(option, part, "is given twice", "give each once");
    distances.push_back(distance);
  }
  if (distances.size() > most) throw not_valid(option, text, "is more than one distance", "give one");
  return distances;
}

std::optional<Exposure> parse_exposure(std::string_view option, std::string_view text) {
  if (text == "auto") return std::nullopt;
  const auto factor = parse_whole_of<double>(text);
  if (!factor || !(*factor >= smallest_exposure && *factor <= largest_exposure))
    throw not_valid(option, text, "is not an exposure", "give `auto` or a positive factor on radiance");
  return Exposure{.factor = static_cast<float>(*factor),
                  .source = option.empty() ? ExposureSource::experiment : ExposureSource::command_line};
}

MethodSpec parse_one_method(std::string_view option, const std::string& text, const std::filesystem::path& folder,
                            MethodParser parse) {
  if (text == "reference") return {.text = text, .name = text, .options = {}};
  const std::vector<MethodSpec> methods = parse(text, folder);
  if (methods.size() == 1) return methods.front();
  throw not_valid(option, text, "is more than one method", "name one");
}

EffectSet parse_effects(std::string_view option, const std::string& text) {
  const std::vector<std::string> names = effect_names(EffectSet{}.set());
  EffectSet effects;
  for (const std::string& word : parts_of(text)) effects.set(find_word(names, word, "effect", option));
  return effects;
}

// The text of a value that may be missing.
template <class Value>
std::function<std::string(RunSettings)> text_of(Field<std::optional<Value>> field) {
  return [=](RunSettings run) { return field(run) ? fmt::format("{}", *field(run)) : std::string(); };
}

template <class Number>
SettingType whole_number_of(Field<Number> field, Number low, Number high) {
  return {.word = "N",
          .takes = range_text(low, high),
          .read_text = [=](RunSettings& run, std::string_view option,
                           const std::string& text) { field(run) = parse_whole_number(option, text, low, high); },
          .text = [=](RunSettings run) { return fmt::format("{}", field(run)); }};
}

// A text that may not be empty, for a field of any type.
template <class Value>
SettingType some_text(Field<std::optional<Value>> field, const char* word, const char* hint,
                      std::string (*text)(const Value&)) {
  return {.word = word,
          .read_text =
              [=](RunSettings& run, std::string_view option, const std::string& given) {
                if (given.empty()) throw not_valid(option, given, "is empty", hint);
                field(run) = given;
              },
          .text = [=](RunSettings run) { return field(run) ? text(*field(run)) : std::string(); }};
}

}  // namespace

SettingType any_text(Field<std::string> field, const char* word) {
  return {.word = word,
          .read_text = [=](RunSettings& run, std::string_view, const std::string& text) { field(run) = text; },
          .text = [=](RunSettings run) { return field(run); }};
}

SettingType any_name(Field<std::optional<std::string>> field, const char* word) {
  return some_text<std::string>(field, word, "give a name, or a number from 0",
                                [](const std::string& name) { return name; });
}

SettingType file_path(Field<std::optional<std::filesystem::path>> field) {
  return some_text<std::filesystem::path>(field, "FILE", "name a file",
                                          [](const std::filesystem::path& path) { return path.string(); });
}

SettingType whole_number(Field<int> field, int low, int high) { return whole_number_of(field, low, high); }

SettingType whole_number(Field<std::uint64_t> field, std::uint64_t low, std::uint64_t high) {
  return whole_number_of(field, low, high);
}

SettingType whole_numbers(Field<std::vector<int>> field, int low, int high) {
  return {
      .word = "LIST",
      .file_takes = fmt::format("a list, each {} to {}", low, high),
      .read_text =
          [=](RunSettings& run, std::string_view option, const std::string& text) {
            field(run).clear();
            for (const std::string& part : parts_of(text))
              field(run).push_back(parse_whole_number(option, part, low, high));
          },
      .text =
          [=](RunSettings run) { return field(run).empty() ? "" : fmt::format("[{}]", fmt::join(field(run), ", ")); },
      .separator = ','};
}

SettingType positive_number(Field<std::optional<double>> field, double low, double high) {
  return {.word = "X",
          .takes = fmt::format("{} to {}", low, high),
          .read_text = [=](RunSettings& run, std::string_view option,
                           const std::string& text) { field(run) = parse_positive(option, text, low, high); },
          .text = text_of(field)};
}

SettingType positive_number(Field<double> field, double low, double high) {
  return {.word = "X",
          .takes = fmt::format("{} to {}", low, high),
          .read_text = [=](RunSettings& run, std::string_view option,
                           const std::string& text) { field(run) = parse_positive(option, text, low, high); },
          .text = [=](RunSettings run) { return fmt::format("{:g}", field(run)); }};
}

SettingType angle(Field<std::optional<double>> field, double most) {
  return {.word = "DEGREES",
          .takes = fmt::format("-{0} to {0}", most),
          .read_text = [=](RunSettings& run, std::string_view option,
                           const std::string& text) { field(run) = parse_angle(option, text, most); },
          .text = text_of(field)};
}

SettingType seconds(Field<std::optional<double>> field) {
  return {.word = "SECONDS",
          .takes = fmt::format("-{0} to {0}", largest_seconds),
          .read_text =
              [=](RunSettings& run, std::string_view option, const std::string& text) {
                const auto number = parse_whole_of<double>(text);
                if (!number || !(std::abs(*number) <= largest_seconds))
                  throw not_valid(option, text, "is not a time",
                                  fmt::format("give seconds from -{0} to {0}", largest_seconds));
                field(run) = *number;
              },
          .text = text_of(field)};
}

SettingType direction(Field<std::optional<glm::dvec3>> field) {
  return {.word = "X,Y,Z",
          .read_text = [=](RunSettings& run, std::string_view option,
                           const std::string& text) { field(run) = parse_direction(option, text); },
          .text =
              [=](RunSettings run) {
                const std::optional<glm::dvec3>& axis = field(run);
                return axis ? fmt::format("{},{},{}", axis->x, axis->y, axis->z) : "";
              }};
}

SettingType fixed_samples(Field<ReferenceSettings> field, int low, int high) {
  return {.word = "N",
          .takes = range_text(low, high),
          .read_text =
              [=](RunSettings& run, std::string_view option, const std::string& text) {
                field(run).spp = parse_whole_number(option, text, low, high);
                field(run).fixed_spp = true;
              },
          .text = [=](RunSettings run) { return fmt::format("{}", field(run).spp); }};
}

SettingType noise(Field<ReferenceSettings> field) {
  return {.word = "X",
          .takes = fmt::format("{} to {}, or auto", least_noise, most_noise),
          .read_text =
              [=](RunSettings& run, std::string_view option, const std::string& text) {
                field(run).by_noise = true;
                field(run).noise = text == "auto"
                                       ? std::nullopt
                                       : std::optional(parse_positive(option, text, least_noise, most_noise));
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
          .takes = most == 1 ? range : range + " each, comma-separated",
          .file_takes = "a list, each " + range,
          .read_text = [=](RunSettings& run, std::string_view option,
                           const std::string& text) { field(run) = parse_distances(option, text, most); },
          .text = [=](RunSettings run) { return fmt::format("{}", fmt::join(field(run), ",")); },
          .separator = ','};
}

SettingType frame_size(Field<std::optional<glm::ivec2>> field) {
  return {.word = "WIDTHxHEIGHT",
          .takes = fmt::format("1 to {} per side, as memory permits", max_frame_side),
          .file_takes = fmt::format("[width, height] or \"WIDTHxHEIGHT\", 1 to {} each", max_frame_side),
          .read_text = [=](RunSettings& run, std::string_view option,
                           const std::string& text) { field(run) = parse_size(option, text); },
          .text = [=](RunSettings run) { return field(run) ? fmt::format("{}x{}", field(run)->x, field(run)->y) : ""; },
          .separator = 'x'};
}

SettingType exposure(Field<std::optional<Exposure>> field) {
  return {.word = "X",
          .takes = "above 0, or auto",
          .read_text = [=](RunSettings& run, std::string_view option,
                           const std::string& text) { field(run) = parse_exposure(option, text); },
          .text = [=](RunSettings run) { return field(run) ? fmt::format("{}", field(run)->factor) : "auto"; }};
}

SettingType footprint_filter(Field<std::optional<FootprintFilter>> field) {
  return {.word = "FILTER",
          .takes = footprint_filter_choices(),
          .read_text = [=](RunSettings& run, std::string_view option,
                           const std::string& text) { field(run) = parse_footprint_filter(text, option); },
          .text = [=](RunSettings run) { return field(run) ? footprint_filter_text(*field(run)) : ""; }};
}

SettingType one_method(Field<std::vector<MethodSpec>> field, MethodParser parse) {
  return {.word = "M",
          .takes = "name or FILE.glsl, or name:option=value",
          .read_text =
              [=](RunSettings& run, std::string_view option, const std::string& text) {
                field(run) = {parse_one_method(option, text, run.method_folder, parse)};
              },
          .text = methods(field).text};
}

SettingType methods(Field<std::vector<MethodSpec>> field, MethodParser parse) {
  return {.word = "LIST",
          .takes = "name, FILE.glsl or name:option=value each, comma-separated",
          .file_takes =
              R"(a list as ["direct", "toksvig:storage=fp16"], or "all" for all but slow ones with their defaults)",
          .read_text =
              [=](RunSettings& run, std::string_view option, const std::string& text) {
                const bool are_all = option.empty() && text == "all";  // in files
                field(run) = are_all ? every_method() : parse(text, run.method_folder);
              },
          .text = [=](RunSettings run) { return fmt::format("{}", fmt::join(texts_of(field(run)), ",")); },
          .separator = ','};
}

SettingType effects(Field<EffectSet> field) {
  return {.word = "LIST",
          .takes = "as cast_shadow,fresnel",
          .file_takes = R"(a list as ["cast_shadow"])",
          .read_text = [=](RunSettings& run, std::string_view option,
                           const std::string& text) { field(run) = parse_effects(option, text); },
          .text = [=](RunSettings run) { return fmt::format("{}", fmt::join(effect_names(field(run)), ",")); },
          .separator = ','};
}

SettingType gpus(Field<std::vector<std::string>> field) {
  return {.word = "NAME,...",
          .takes = fmt::format("{}, all", fmt::join(chip_names(), ", ")),
          .file_takes = R"(a list as ["Steam Deck", "RX 6800"], or ["all"])",
          .read_text =
              [=](RunSettings& run, std::string_view option, const std::string& text) {
                std::vector<std::string> names;
                for (const Chip* chip : chips_named(option, parts_of(text))) names.emplace_back(chip->name);
                field(run) = names;
              },
          .text = [=](RunSettings run) { return fmt::format("{}", fmt::join(field(run), ",")); },
          .separator = ','};
}

SettingType no_folder(Field<std::optional<std::filesystem::path>> field) {
  return {.read_text = [=](RunSettings& run, std::string_view, const std::string&) { field(run).reset(); },
          .text = [](const RunSettings&) { return std::string(); }};
}

}  // namespace footprint::setting_types
