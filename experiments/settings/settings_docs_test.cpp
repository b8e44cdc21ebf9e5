// The tables of settings in docs/reference/command-line.md and docs/reference/experiments.md are those of the program.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "experiments/settings/setting.hpp"
#include "tests/support/source_folder.hpp"

namespace footprint {
namespace {

// The default: a value, or words for it.
std::string default_cell(const Setting& setting) {
  if (setting.required) return "required";
  if (!setting.otherwise.empty()) return std::string(setting.otherwise);
  const std::string text = default_text(setting);
  return text.empty() ? "" : fmt::format("`{}`", text);
}

std::string option_cell(const Setting& setting) {
  const std::string& word = setting.type.word;
  if (!setting.option.starts_with('-')) return fmt::format("`{}`", word);
  return word.empty() ? fmt::format("`{}`", option_name(setting)) : fmt::format("`{} {}`", option_name(setting), word);
}

std::string table_of_options() {
  std::string text = "| option | of | takes | default | meaning |\n|---|---|---|---|---|\n";
  for (const Setting& setting : run_settings()) {
    if (setting.option.empty()) continue;
    text += fmt::format("| {} | {} | {} | {} | {} |\n", option_cell(setting), fmt::join(setting.commands, ", "),
                        setting.type.takes, default_cell(setting), setting.help);
  }
  return text;
}

std::string table_of_keys() {
  std::string text = "| table | key | takes | default | meaning |\n|---|---|---|---|---|\n";
  for (const std::string_view table : {"experiment", "zoom", "reference"}) {
    for (const Setting& setting : run_settings()) {
      if (setting.key.empty() || setting.key.table != table) continue;
      text += fmt::format("| `[{}]` | `{}` | {} | {} | {} |\n", table, setting.key.name,
                          setting.type.file_takes.empty() ? setting.type.takes : setting.type.file_takes,
                          default_cell(setting), setting.help);
    }
  }
  return text;
}

// The text of a document between the marks around the settings.
std::string settings_in(const std::string& document) {
  std::ifstream file(testing::source_folder() / "docs/reference" / document);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const std::string begin = "<!-- settings of a run -->\n", end = "<!-- end of the settings -->\n";
  const std::size_t from = text.find(begin), to = text.find(end);
  if (from == std::string::npos || to == std::string::npos) return document + " has no marks around the settings";
  return text.substr(from + begin.size(), to - from - begin.size());
}

TEST(SettingsDocs, TheCommandLineIsTheTable) { EXPECT_EQ(settings_in("command-line.md"), table_of_options()); }

TEST(SettingsDocs, ExperimentsAreTheTable) { EXPECT_EQ(settings_in("experiments.md"), table_of_keys()); }

// Keys of a table that the documents' test does not know would be left out of it.
TEST(SettingsDocs, EveryKeyIsShown) {
  const std::string shown = table_of_keys();
  for (const Setting& setting : run_settings()) {
    if (setting.key.empty()) continue;
    EXPECT_NE(shown.find(fmt::format("`{}` |", setting.key.name)), std::string::npos) << setting.key.name;
  }
}

}  // namespace
}  // namespace footprint
