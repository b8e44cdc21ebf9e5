// The process: the machine that it runs on, and Ctrl-C, turned into an Error at the next safe point.
#pragma once

#include <string>

namespace footprint {

/// The network name of this machine; "?" if it has none.
[[nodiscard]] std::string host_name();

/// Installs handlers for SIGINT, SIGTERM and SIGHUP (unless it is ignored) that set a flag. A second signal ends the
/// process at once.
void watch_interrupts();

/// Throws Error (interrupted) after such a signal. It is cheap, so call it in every long loop.
void throw_if_interrupted();

}  // namespace footprint
