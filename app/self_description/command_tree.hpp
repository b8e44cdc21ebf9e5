// The command line told as plain values: what the manual page and the completions of shells are written from.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace footprint {

/// An option or a positional argument, as --help shows it.
struct CommandOption {
  std::vector<std::string> names;  ///< "-o", "--output"; of a positional argument its name alone
  std::string value;               ///< what it takes, "TEXT" or "INT in [1 - 4096]"; empty: it is a flag
  std::string help;
  bool positional = false;
  bool required = false;
};

/// A command with its subcommands.
struct CommandPage {
  std::string name;  ///< "compare"; of the program itself "footprint"
  std::string summary;
  std::string notes;  ///< what --help prints at its end: paragraphs, and examples with two spaces before each line
  std::vector<CommandOption> options;
  std::vector<CommandPage> subcommands;
};

/// All that `app` shows to people: options and subcommands without a group are left out.
[[nodiscard]] CommandPage command_tree(const CLI::App& app);

}  // namespace footprint
