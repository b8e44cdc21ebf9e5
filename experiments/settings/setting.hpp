// The settings of a run as users write them: one table for the command line, experiment files, --help and the docs.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/settings/run_settings.hpp"

namespace footprint {

class TomlTable;

/// The text form of a value, and its place in a RunSettings; setting_types.hpp makes them.
struct SettingType {
  std::string word{};        ///< placeholder of the value in the help: "N", "WIDTHxHEIGHT"; empty: a flag
  std::string takes{};       ///< the values of an option: "1 to 4096"; empty if the help says it
  std::string file_takes{};  ///< the values of a key in an experiment's file; empty: as `takes`
  /// Reads a value into `run`. `option` is the option's name, or empty for a key of a file. Errors (usage) name it.
  std::function<void(RunSettings& run, std::string_view option, const std::string& text)> read_text;
  /// The value as an option takes it; empty: there is none.
  std::function<std::string(RunSettings run)> text;
  /// The separator in the text of a list, which is an array in a file; 0: the value is not a list.
  char separator = 0;
};

/// A row of the table.
struct Setting {
  std::string_view option{};  ///< "--method,--methods"; without dashes an argument; empty: in files alone
  std::vector<std::string_view> commands{};  ///< subcommands that have the option
  std::string_view table{}, key{};           ///< in an experiment's file; empty: on the command line alone
  SettingType type{};
  std::string_view help{};       ///< a clause in lower case, without a full stop
  std::string_view start{};      ///< default value, as an option takes it; empty: that of RunSettings
  std::string_view otherwise{};  ///< the default in words: "the scene's"
  bool required = false;
  std::string_view group{};  ///< heading in the help
};

/// The document that explains an experiment's file.
inline constexpr std::string_view experiments_document = "docs/reference/experiments.md";

/// Every setting, in the order of the help and of the documents.
[[nodiscard]] std::span<const Setting> run_settings();

/// The name of a setting's option: "--method" of "--method,--methods".
[[nodiscard]] std::string_view option_name(const Setting& setting);

/// The default value, as an option takes it; empty: no value.
[[nodiscard]] std::string default_text(const Setting& setting);

/// The keys of [`table`] in an experiment's file.
[[nodiscard]] std::vector<std::string> setting_keys(std::string_view table);

/// Reads the settings of [`name`] from an experiment's file. Errors (usage) name file, line and key: a value is not
/// valid, or a required key is missing and not among those `given` elsewhere.
void read_settings(const TomlTable& table, std::string_view name, RunSettings& run,
                   const std::vector<std::string>& given = {});

}  // namespace footprint
