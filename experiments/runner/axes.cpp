// Reads axes through the settings that they vary, and multiplies them out.
#include "experiments/runner/axes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>

#include "experiments/settings/setting.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/names.hpp"
#include "renderer/core/toml_table.hpp"

namespace footprint {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 4> varied_keys{"scene", "size", "footprint", "seed"};  // keys of settings

const Setting& setting_of(std::string_view key) {
  return *std::ranges::find_if(run_settings(), [&](const Setting& setting) { return setting.key.name == key; });
}

// The value as its setting writes it, so that one value has one name.
std::string written_by_setting(const std::string& key, const std::string& value) {
  RunSettings run;
  const Setting& setting = setting_of(key);
  setting.type.read(run, "", value);
  return setting.type.text(run);
}

// The name of a value in a folder's name; of a path only its distinctive part.
std::string value_name(const std::string& key, const std::string& value) {
  if (key == "seed") return key + value;
  if (key != "scene") return value;
  const fs::path path(value);
  if (path.filename() == "scene.toml") return path.parent_path().filename().string();
  return path.has_extension() ? path.stem().string() : path.filename().string();
}

// `text` with an option, in the place of the value that it has for it.
std::string with_option(const std::string& text, const std::string& option, const std::string& value) {
  const std::string given = fmt::format(":{}=", option);
  const std::size_t start = text.find(given);
  if (start == std::string::npos) return fmt::format("{}{}{}", text, given, value);
  const std::size_t end = std::min(text.find(':', start + 1), text.size());
  return text.substr(0, start) + given + value + text.substr(end);
}

}  // namespace

std::vector<std::string> axis_keys(std::string_view table) {
  std::vector<std::string> keys;
  for (const std::string_view key : varied_keys) {
    if (table.empty() || table == setting_of(key).key.table) keys.emplace_back(key);
  }
  return keys;
}

void set_value(Experiment& experiment, const std::string& key, const std::string& value) {
  setting_of(key).type.read(experiment.run, key, value);
  if (key == "scene") experiment.run.scene = scene_of_file(experiment.file, value);
}

Axis read_axis(const TomlTable& table, const std::string& key) {
  Axis axis{.key = key};
  const std::vector<std::string> values = table.words_or_numbers(key).value();
  for (const std::string& written : values) {
    const std::string value = at_key(table, key, [&] { return written_by_setting(key, written); });
    if (value.empty()) throw table.error_at(key, "has an empty value", "fill it in, or leave it out");
    if (std::ranges::find(axis.values, value) != axis.values.end())
      throw table.error_at(key, fmt::format("has `{:.80}` twice", value), "give each once");
    axis.values.push_back(value);
  }
  return axis;
}

std::vector<std::string> times_options(const TomlTable& table, const std::string& method, const std::string& text) {
  std::vector<std::string> texts{text};
  const std::vector<std::string> options = table.keys_of(method);
  if (options.empty()) throw table.error_at(method, "varies nothing", "write METHOD = { option = [1, 2] }");
  const TomlTable axes = *table.table(method, options);
  for (const std::string& option : options) {
    const std::vector<std::string> values = axes.words_or_numbers(option).value();
    std::vector<std::string> longer;
    for (const std::string& shorter : texts) {
      for (const std::string& value : values) longer.push_back(with_option(shorter, option, value));
    }
    texts = std::move(longer);
    if (texts.size() > most_methods)
      throw table.error_at(method, fmt::format("makes more than {} methods", most_methods), "leave values out");
  }
  return texts;
}

std::vector<Coordinates> multiplied_out(const std::vector<Axis>& axes) {
  std::vector<Coordinates> all{{}};
  for (const Axis& axis : axes) {
    std::vector<Coordinates> longer;
    for (const Coordinates& start : all) {
      for (const std::string& value : axis.values) {
        longer.push_back(start);
        longer.back().emplace_back(axis.key, value);
      }
    }
    all = std::move(longer);
  }
  return all;
}

std::vector<std::string> names_of_places(const std::vector<Coordinates>& places, std::vector<std::string> others) {
  std::vector<std::string> names = others;
  for (const Coordinates& place : places) {
    std::string name;
    for (const auto& [key, value] : place) name += (name.empty() ? "" : "-") + value_name(key, value);
    names.push_back(name);
  }
  names = distinct_stems(names);
  names.erase(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(others.size()));
  return names;
}

}  // namespace footprint
