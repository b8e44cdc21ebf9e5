// What the command line says of itself: `--help` and the completions in a shell. The program itself offers a shell's
// words, so the shell's script is a few lines.
#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace footprint {

/// Prints an option as "-o, --output DIR", its meaning, its range and its default.
class HelpFormat : public CLI::Formatter {
 public:
  static constexpr std::size_t width = 100;

  HelpFormat();

  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
  std::string make_description(const CLI::App* app) const override;
  std::string make_usage(const CLI::App* app, std::string name) const override;
  std::string make_option(const CLI::Option* option, bool is_positional) const override;
  std::string make_subcommand(const CLI::App* command) const override;
};

/// The names that `footprint list KIND` prints.
using NamesOf = std::function<std::vector<std::string>(std::string_view kind)>;

/// The script that a shell loads; it calls `footprint completions offer -- WORD...`. Errors (usage): the shell is not
/// bash, zsh or fish.
[[nodiscard]] std::string completion_script(std::string_view shell);

/// The words that can replace the last of `words`, which follow the program's name: subcommands, options, or the names
/// that an argument takes. One line per word, with a tab and its description. Empty if a shell should offer files.
[[nodiscard]] std::string offered_words(const CLI::App& program, std::span<const std::string> words,
                                        const NamesOf& names_of);

}  // namespace footprint
