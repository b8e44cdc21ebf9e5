// What the parser of the command line refuses, as an Error with the nearest right name.
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

}  // namespace footprint
