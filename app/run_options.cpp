// Adds rows of the table of settings to the parser of the command line, and reads their values.
#include "app/run_options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>

#include "app/folders.hpp"
#include "renderer/core/disk_cache.hpp"

namespace footprint {
namespace {

// "Random seed of the reference (0 or more); default: 1".
std::string help_text(const Setting& setting) {
  std::string text(setting.help);
  text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  if (!setting.type.takes.empty()) text += fmt::format(" ({})", setting.type.takes);
  if (!setting.otherwise.empty()) text += fmt::format("; default: {}", setting.otherwise);
  return text;
}

const CLI::Option* add_option(CLI::App& command, const Setting& setting) {
  const std::string names(setting.option), help = help_text(setting);
  const std::string group(setting.group);
  if (setting.type.word.empty()) return command.add_flag(names, help)->group(group);
  CLI::Option* option = command.add_option(names, help)->type_name(setting.type.word)->required(setting.required);
  if (names.starts_with('-')) option->group(group);
  return option->default_str(default_text(setting));
}

}  // namespace

RunOptions::RunOptions(CLI::App& command) {
  for (const Setting& setting : run_settings()) {
    if (std::ranges::find(setting.commands, command.get_name()) == setting.commands.end()) continue;
    added_.push_back({&setting, add_option(command, setting)});
  }
}

void RunOptions::apply(RunSettings& run) const {
  run.scene_library = scene_library();
  run.cache = default_cache_folder();
  for (const auto& [setting, option] : added_) {
    const std::string text = option->count() > 0 ? option->results().front() : std::string(setting->start);
    if (option->count() > 0 || !text.empty()) setting->type.read_text(run, option_name(*setting), text);
  }
}

RunSettings RunOptions::settings() const {
  RunSettings run;
  apply(run);
  return run;
}

std::vector<std::string> RunOptions::given_of(std::string_view table) const {
  std::vector<std::string> given;
  for (const auto& [setting, option] : added_) {
    if (setting->table == table && option->count() > 0) given.emplace_back(option_name(*setting));
  }
  return given;
}

void add_quiet_flag(CLI::App& command, bool& quiet) {
  command.add_flag("-q,--quiet", quiet, "No progress on standard error");
}

}  // namespace footprint
