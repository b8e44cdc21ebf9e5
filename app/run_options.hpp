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

/// The options of a subcommand that are settings of a run. Must outlive the parsing and running of the subcommand.
class RunOptions {
 public:
  /// Adds the options that the table has for `command`'s name.
  explicit RunOptions(CLI::App& command);

  /// Overwrites settings of `run` with the options given, and sets the folders of scenes and the cache. Call it after
  /// the whole command line has been parsed. Errors (usage) name the option; (machine): an image of --size does not fit
  /// in memory.
  void apply(RunSettings& run) const;

  /// The same over the defaults of a run.
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
