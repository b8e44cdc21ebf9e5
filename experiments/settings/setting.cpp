// Reads, writes and describes settings by their table; reads methods that are files, checks the options of each method
// in a text, and finds figures by their names.
#include "experiments/settings/setting.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "renderer/bake/baked_method.hpp"
#include "renderer/bake/method_file.hpp"
#include "renderer/core/toml_table.hpp"
#include "renderer/scene/settings/toml_values.hpp"

namespace footprint {
namespace {

// A number, or true and false of a switch.
SettingInput single_input(const TomlTable& table, std::string_view key, const SettingType& type) {
  const TomlScalar value = *table.scalar(key);
  if (std::holds_alternative<bool>(value) && !type.is_switch)
    throw table.error_at(key, "must be a number", "write it without quotes");
  return SettingInput(value);
}

SettingInput listed_input(const TomlTable& table, std::string_view key, char separator) {
  std::vector<TomlScalar> parts = *table.scalars(key);
  for (const TomlScalar& part : parts) {
    const auto* const word = std::get_if<std::string>(&part);
    if (word != nullptr && word->find(separator) != std::string::npos)
      throw table.error_at(key, fmt::format("has `{:.80}`", *word), "write each value on its own");
  }
  return SettingInput(std::move(parts));
}

// The value of a key. A list may be written as a text too.
SettingInput input_at(const TomlTable& table, std::string_view key, const SettingType& type) {
  if (!table.is_word(key))
    return type.separator == 0 ? single_input(table, key, type) : listed_input(table, key, type.separator);
  std::string word = *table.word(key);
  if (word.empty()) throw table.error_at(key, "is empty", "fill it in");
  return word;
}

// The setting of histories of that key, which is an option of methods too; null: there is none.
const Setting* history_setting(std::string_view key) {
  const auto found = std::ranges::find_if(
      run_settings(), [&](const Setting& setting) { return setting.key.name == key && key.starts_with("history"); });
  return found == run_settings().end() ? nullptr : &*found;
}

void read_option(RunSettings& run, const MethodSpec& method, const std::string& name, const std::string& value) {
  history_setting(name)->type.read(run, fmt::format("{} of method {}", name, method.name), value);
}

// Moves the options of its history out of those of its maps, whose names are the method's own.
void separate_history(MethodSpec& method) {
  RunSettings unused;
  std::erase_if(method.options, [&](const auto& option) {
    if (history_setting(option.first) == nullptr) return false;
    read_option(unused, method, option.first, option.second);
    method.history.insert(option);
    return true;
  });
}

// Checks methods and their options, and reads those that are files.
void take_known(std::span<MethodSpec> methods, const std::filesystem::path& folder) {
  for (MethodSpec& method : methods) {
    if (names_method_file(method.name)) method.file = read_method_file(method.name, folder);
    (void)options_of(find_method(method), method);
  }
}

}  // namespace

std::string_view option_name(const Setting& setting) {
  std::string_view names = setting.option;
  if (names.starts_with('-') && !names.starts_with("--")) names.remove_prefix(names.find(',') + 1);
  return names.substr(0, names.find(','));
}

std::string default_text(const Setting& setting) {
  return setting.start.empty() ? setting.type.text({}) : std::string(setting.start);
}

std::vector<std::string> setting_keys(std::string_view table) {
  std::vector<std::string> keys;
  for (const Setting& setting : run_settings()) {
    if (!setting.key.empty() && setting.key.table == table) keys.emplace_back(setting.key.name);
  }
  return keys;
}

void read_settings(const TomlTable& table, std::string_view name, RunSettings& run,
                   const std::vector<std::string>& given) {
  for (const Setting& setting : run_settings()) {
    const std::string_view key = setting.key.name;
    if (key.empty() || setting.key.table != name) continue;
    if (table.has(key)) {
      const SettingInput input = input_at(table, key, setting.type);
      at_key(table, key, [&] { setting.type.read(run, "", input); });
    } else if (setting.required && std::ranges::find(given, key) == given.end()) {
      refuse_missing(table, key, experiments_document);
    }
  }
}

std::vector<MethodSpec> parse_known_methods(const std::string& text, const std::filesystem::path& folder) {
  std::vector<MethodSpec> methods = parse_methods(text);
  take_known(methods, folder);
  return methods;
}

std::vector<std::string> texts_of(std::span<const MethodSpec> methods) {
  std::vector<std::string> texts;
  texts.reserve(methods.size());
  for (const MethodSpec& method : methods) texts.push_back(method.text);
  return texts;
}

std::vector<MethodSpec> every_method() {
  std::vector<MethodSpec> methods;
  for (const Method* method : all_methods()) {
    if (method->info.slow_frame) continue;
    methods.push_back({.text = method->info.name, .name = method->info.name, .options = {}});
  }
  return methods;
}

const Quantity* find_quantity(const Method& method, const std::string& name) {
  const auto all = quantities_of(method);
  const auto found = std::ranges::find(all, name, &Quantity::name);
  return found == all.end() ? nullptr : &*found;
}

std::vector<std::string> quantity_names(std::span<const MethodSpec> methods) {
  std::vector<std::string> names;
  for (const MethodSpec& method : methods) {
    for (const Quantity& quantity : quantities_of(find_method(method))) {
      if (std::ranges::find(names, quantity.name) == names.end()) names.push_back(quantity.name);
    }
  }
  return names;
}

std::vector<MethodSpec> parse_methods_with_histories(const std::string& text, const std::filesystem::path& folder) {
  std::vector<MethodSpec> methods = parse_methods(text);
  for (MethodSpec& method : methods) separate_history(method);
  take_known(methods, folder);
  return methods;
}

HistorySettings history_of(const MethodSpec& method, const HistorySettings& common) {
  RunSettings run;
  run.history = common;
  for (const auto& [name, value] : method.history) read_option(run, method, name, value);
  return run.history;
}

std::size_t count_histories(std::span<const MethodSpec> methods, const HistorySettings& common) {
  return static_cast<std::size_t>(
      std::ranges::count_if(methods, [&](const MethodSpec& method) { return history_of(method, common).frames > 0; }));
}

}  // namespace footprint
