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

/// How a value is written, and where in a RunSettings it goes; setting_types.hpp makes them.
struct SettingType {
  std::string word;          ///< stands for the value in the help: "N", "WIDTHxHEIGHT"; empty: a flag, without a value
  std::string option_takes;  ///< "1 to 4096"; empty where the help says all
  std::string file_takes;    ///< the same of a key in an experiment's file
  /// Reads the value of an option that is called so. Errors (usage) name the option.
  std::function<void(RunSettings& run, std::string_view option, const std::string& text)> read_text;
  /// Reads a key that the table has. Errors (usage) name file, line and key.
  std::function<void(RunSettings& run, const TomlTable& table, std::string_view key)> read_file;
  /// The value as an option takes it; empty: there is none.
  std::function<std::string(RunSettings run)> text;
};

/// A row of the table.
struct Setting {
  std::string_view option{};  ///< "--method,--methods"; without dashes an argument; empty: in files alone
  std::vector<std::string_view> commands{};  ///< subcommands that have the option
  std::string_view table{}, key{};           ///< in an experiment's file; empty: on the command line alone
  SettingType type{};
  std::string_view help{};       ///< what it is, as a clause without a full stop; in lower case
  std::string_view start{};      ///< value where none is given, as an option takes it; empty: RunSettings' own
  std::string_view otherwise{};  ///< what counts without a value, in words: "the scene's"
  bool required = false;
  std::string_view group{};  ///< heading in the help
};

/// The document that explains an experiment's file.
inline constexpr std::string_view experiments_document = "docs/experiments.md";

/// Every setting, in the order of the help and of the docs.
[[nodiscard]] std::span<const Setting> run_settings();

/// The name of a setting's option: "--method" of "--method,--methods".
[[nodiscard]] std::string_view option_name(const Setting& setting);

/// What is there where a user gives nothing, as an option takes it; empty: no value.
[[nodiscard]] std::string default_text(const Setting& setting);

/// The keys of [`table`] in an experiment's file.
[[nodiscard]] std::vector<std::string> setting_keys(std::string_view table);

/// Reads the settings of [`name`] from an experiment's file. Errors (usage) name file, line and key: a value that does
/// not fit, a required key that is missing and not among those that are `given` elsewhere.
void read_settings(const TomlTable& table, std::string_view name, RunSettings& run,
                   const std::vector<std::string>& given = {});

}  // namespace footprint
