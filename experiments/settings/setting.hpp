// The settings of a run as users write them: one table for the command line, experiment files, --help and the docs; and
// its methods: read, checked against those of the program, their figures that no image shows, and their histories.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/settings/run_settings.hpp"
#include "experiments/settings/setting_input.hpp"
#include "methods/registry.hpp"

namespace footprint {

class TomlTable;

/// The form of a value, and its place in a RunSettings; setting_types.hpp makes them.
struct SettingType {
  std::string word{};        ///< placeholder of the value in the help: "N", "WIDTHxHEIGHT"; empty: a flag
  std::string takes{};       ///< the values of an option: "1 to 4096"; empty if the help says it
  std::string file_takes{};  ///< the values of a key in an experiment's file; empty: as `takes`
  /// Reads a value into `run`. `option` is the option's name, or empty for a key of a file. Errors (usage) name it.
  std::function<void(RunSettings& run, std::string_view option, const SettingInput& input)> read;
  /// The value as an option takes it; empty: there is none.
  std::function<std::string(RunSettings run)> text;
  /// The separator in the text of a list, which is an array in a file; 0: the value is not a list.
  char separator = 0;
  bool is_switch = false;  ///< a file may write true or false
  bool repeats = false;    ///< the option may be given several times, each with a value to add
};

/// A key of an experiment's file.
struct SettingKey {
  std::string_view table{}, name{};

  [[nodiscard]] bool empty() const { return name.empty(); }
};

/// A row of the table.
struct Setting {
  std::string_view option{};  ///< "--method,--methods"; without dashes an argument; empty: in files alone
  std::vector<std::string_view> commands{};  ///< subcommands that have the option
  SettingKey key{};                          ///< empty: on the command line alone
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

/// The long name of a setting's option, the first of several: "--method" of "--method,--methods", "--verbose" of
/// "-v,--verbose".
[[nodiscard]] std::string_view option_name(const Setting& setting);

/// The default value, as an option takes it; empty: no value.
[[nodiscard]] std::string default_text(const Setting& setting);

/// The keys of [`table`] in an experiment's file.
[[nodiscard]] std::vector<std::string> setting_keys(std::string_view table);

/// Reads the settings of [`name`] from an experiment's file. Errors (usage) name file, line and key: a value is not
/// valid, or a required key is missing and not among those `given` elsewhere.
void read_settings(const TomlTable& table, std::string_view name, RunSettings& run,
                   const std::vector<std::string>& given = {});

/// Comma-separated methods with their options, checked before anything is loaded; those that are files are read
/// (read_method_file).
/// folder: where a file's relative path starts.
/// Errors (usage): unknown method or option, with the nearest name; a file's.
[[nodiscard]] std::vector<MethodSpec> parse_known_methods(const std::string& text,
                                                          const std::filesystem::path& folder = {});

/// The methods as they were written.
[[nodiscard]] std::vector<std::string> texts_of(std::span<const MethodSpec> methods);

/// Every method of the program except slow ones (MethodInfo::slow_frame), with its defaults.
[[nodiscard]] std::vector<MethodSpec> every_method();

/// A method's figure of that name; null where it has none.
[[nodiscard]] const Quantity* find_quantity(const Method& method, const std::string& name);

/// The names of all figures of some methods, each once.
[[nodiscard]] std::vector<std::string> quantity_names(std::span<const MethodSpec> methods);

/// Methods, each of which may have options of its own history. Errors (usage): those of parse_known_methods, or a value
/// that its option does not take.
[[nodiscard]] std::vector<MethodSpec> parse_methods_with_histories(const std::string& text,
                                                                   const std::filesystem::path& folder = {});

/// The history of a method's frames.
/// common: that of the run's methods; options of the method's own replace it.
[[nodiscard]] HistorySettings history_of(const MethodSpec& method, const HistorySettings& common);

/// The number of a run's methods whose images are histories.
[[nodiscard]] std::size_t count_histories(std::span<const MethodSpec> methods, const HistorySettings& common);

}  // namespace footprint
