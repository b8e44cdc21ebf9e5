// Reads, writes and describes settings by their table.
#include "experiments/settings/setting.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "renderer/core/toml_table.hpp"
#include "renderer/scene/settings/toml_values.hpp"

namespace footprint {
namespace {

constexpr double largest_exact = 9007199254740992.0;  // 2^53: TOML's numbers are read as doubles

// A key's value as an option takes it.
std::string text_at(const TomlTable& table, std::string_view key, const SettingType& type) {
  if (table.is_word(key)) return *table.word(key);
  if (type.separator == 0) return fmt::format("{}", *table.number(key, {-largest_exact, largest_exact}));
  const std::vector<std::string> parts = *table.words_or_numbers(key);
  for (const std::string& part : parts) {
    if (part.find(type.separator) != std::string::npos)
      throw table.error_at(key, fmt::format("has `{:.80}`", part), "write each value on its own");
  }
  return fmt::format("{}", fmt::join(parts, std::string(1, type.separator)));
}

}  // namespace

std::string_view option_name(const Setting& setting) { return setting.option.substr(0, setting.option.find(',')); }

std::string default_text(const Setting& setting) {
  return setting.start.empty() ? setting.type.text({}) : std::string(setting.start);
}

std::vector<std::string> setting_keys(std::string_view table) {
  std::vector<std::string> keys;
  for (const Setting& setting : run_settings()) {
    if (!setting.key.empty() && setting.table == table) keys.emplace_back(setting.key);
  }
  return keys;
}

void read_settings(const TomlTable& table, std::string_view name, RunSettings& run,
                   const std::vector<std::string>& given) {
  for (const Setting& setting : run_settings()) {
    if (setting.key.empty() || setting.table != name) continue;
    if (table.has(setting.key)) {
      const std::string text = text_at(table, setting.key, setting.type);
      if (text.empty()) throw table.error_at(setting.key, "is empty", "fill it in");
      at_key(table, setting.key, [&] { setting.type.read_text(run, "", text); });
    } else if (setting.required && std::ranges::find(given, setting.key) == given.end()) {
      refuse_missing(table, setting.key, experiments_document);
    }
  }
}

}  // namespace footprint
