// What the parser of the command line refuses, as an Error with the nearest right name; and the Error of a command that
// got no memory.
#pragma once

#include "renderer/core/error.hpp"

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace footprint {

/// The usage error for `error`, which parsing with `app` threw: an unknown subcommand or option comes before what is
/// missing because of it.
[[nodiscard]] Error usage_error(const CLI::App& app, const CLI::ParseError& error);

/// Where `app`'s subcommand threw std::bad_alloc: names what it was to work on, how large, and what was taken.
[[nodiscard]] Error memory_error(const CLI::App& app);

}  // namespace footprint
