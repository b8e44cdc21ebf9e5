// The manual page, footprint(1), written from the command line itself.
#pragma once

#include <string>

#include "app/self_description/command_tree.hpp"

namespace footprint {

/// The page in roff with man(7)'s macros: name, synopsis, each command with its options, exit codes, files.
[[nodiscard]] std::string manual_page(const CommandPage& program, const std::string& version);

}  // namespace footprint
