// The settings of a run as options of a subcommand, by their table (experiments/settings/setting.hpp).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "experiments/settings/setting.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace footprint {

/// The options that a subcommand has of the table. Lives as long as the subcommand is being parsed and run.
class RunOptions {
 public:
  /// Adds them to `command`, by its name.
  explicit RunOptions(CLI::App& command);

  /// What was given, put over `run`, with the folders that the program knows: scenes, surfaces, cache. For after the
  /// whole command line has been parsed. Errors (usage) name the option; (machine): one picture of --size is more than
  /// memory holds.
  void apply(RunSettings& run) const;

  /// The same over a run's own defaults.
  [[nodiscard]] RunSettings settings() const;

  /// The options given that have a key in [`table`] of an experiment's file: "--spp" of [reference].
  [[nodiscard]] std::vector<std::string> given_of(std::string_view table) const;

 private:
  struct Added {
    const Setting* setting;
    const CLI::Option* option;
  };
  std::vector<Added> added_;
};

/// Adds --quiet.
void add_quiet_flag(CLI::App& command, bool& quiet);

}  // namespace footprint
