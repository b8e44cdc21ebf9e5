// The process: the machine that it runs on, and Ctrl-C, turned into an Error at the next safe point.
#pragma once

#include <string>

namespace footprint {

/// The name that this machine goes by on its network; "?" where it has none. Times belong to one.
[[nodiscard]] std::string host_name();

/// Installs handlers for SIGINT, SIGTERM and SIGHUP (where it is not ignored) that only set a flag; a second such
/// signal ends the process at once.
void watch_interrupts();

/// Throws Error{interrupted} if the user asked to stop since `watch_interrupts`. Cheap: call it in every long loop.
void throw_if_interrupted();

}  // namespace footprint
