// Completions of the command line in a shell. The program itself offers the words, so a shell's script is a few lines.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace footprint {

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
