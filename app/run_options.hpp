// Options that subcommands share: settings of a run by their table (experiments/settings/setting.hpp), and MAP.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/settings/setting.hpp"
#include "renderer/scene/settings/part.hpp"

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

/// The arguments of a subcommand that has settings of a run.
struct RunArguments {
  explicit RunArguments(CLI::App& command) : run(command) {}

  RunOptions run;
  bool quiet = false;
};

/// Adds --quiet.
void add_quiet_flag(CLI::App& command, bool& quiet);

/// Adds an option or argument with a value that the help calls `type`.
CLI::Option* add_value(CLI::App& command, const std::string& names, auto& value, const std::string& type,
                       const std::string& help) {
  return command.add_option(names, value, help)->type_name(type);
}

/// Adds --output, a folder; `help` says what it gets.
inline CLI::Option* add_output_folder(CLI::App& command, std::string& output, const std::string& help) {
  return add_value(command, "-o,--output", output, "DIR", help)->capture_default_str();
}

/// Adds a subcommand that does `work`. Its arguments add their options when they are made, and live as long as `app`.
template <class Arguments>
void add_command(CLI::App& app, const std::string& name, const std::string& description, const std::string& footer,
                 void (*work)(const Arguments&)) {
  CLI::App* command = app.add_subcommand(name, description);
  const auto arguments = std::make_shared<Arguments>(*command);
  command->footer(footer);
  command->callback([arguments, work] { work(*arguments); });
}

/// A check of a number from `low` to `high`, both inclusive. Unlike CLI::Range it refuses NaN, and prints short limits.
[[nodiscard]] inline CLI::Validator within(double low, double high) {
  const std::string range = fmt::format("{:g} to {:g}", low, high);
  return {[low, high, range](std::string& text) {
            double value = 0.0;
            if (!CLI::detail::lexical_cast(text, value) || std::isnan(value))
              return "Value " + text + " is not a number";
            return value >= low && value <= high ? std::string() : "Value " + text + " not in range " + range;
          },
          fmt::format("FLOAT in [{:g} - {:g}]", low, high)};
}

/// The options of a subcommand that say how its MAP is read. Must outlive the parsing and running of the subcommand.
class MapOptions {
 public:
  void add_to(CLI::App& command) {
    auto* scale =
        command.add_option("--height-scale", scale_, "MAP stores heights; the height of value 1 in widths of the map")
            ->type_name("X")
            ->check(within(-100.0, 100.0));
    command.add_option("--slope-filter", filter_, "Derivative of the heights: central, sobel or scharr")
        ->type_name("WORD")
        ->needs(scale)
        ->capture_default_str();
  }

  /// The file with these options. Throws Error (usage): an unknown filter.
  [[nodiscard]] NormalFile of(const std::string& path) const {
    NormalFile file{.path = path};
    const SlopeFilter filter = word_value(slope_filters, filter_, "slope filter", "--slope-filter");
    if (!scale_) return file;
    file.scale = *scale_;
    file.heights = HeightSettings{.filter = filter};
    return file;
  }

 private:
  std::optional<double> scale_;
  std::string filter_ = "central";
};

}  // namespace footprint
