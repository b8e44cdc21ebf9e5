// Completions of the command line for shells, written from the command line itself.
#pragma once

#include <string>
#include <string_view>

#include "app/self_description/command_tree.hpp"

namespace footprint {

/// A script that a shell loads: subcommands, options, and what the program itself lists (methods, scenes, experiments)
/// where an argument takes one; files elsewhere. `shell` is bash, zsh or fish. Errors (usage): another one.
[[nodiscard]] std::string completion_script(const CommandPage& program, std::string_view shell);

}  // namespace footprint
