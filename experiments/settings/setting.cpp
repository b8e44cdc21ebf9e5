// What is done with the table of settings, whatever stands in it.
#include "experiments/settings/setting.hpp"

#include <algorithm>

#include "renderer/core/toml_table.hpp"
#include "renderer/scene/settings/toml_values.hpp"

namespace footprint {

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
      setting.type.read_file(run, table, setting.key);
    } else if (setting.required && std::ranges::find(given, setting.key) == given.end()) {
      refuse_missing(table, setting.key, experiments_document);
    }
  }
}

}  // namespace footprint
