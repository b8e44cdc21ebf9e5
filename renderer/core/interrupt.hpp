// Ctrl-C, turned into an Error at the next safe point, so that nothing is left half-written.
#pragma once

namespace footprint {

/// Installs handlers for SIGINT, SIGTERM and SIGHUP (where it is not ignored) that only set a flag; a second such
/// signal ends the process at once.
void watch_interrupts();

/// Throws Error{interrupted} if the user asked to stop since `watch_interrupts`. Cheap: call it in every long loop.
void throw_if_interrupted();

}  // namespace footprint
