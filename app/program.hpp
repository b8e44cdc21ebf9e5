// The whole program as a function.
#pragma once

namespace footprint {

/// Runs the subcommand that the arguments name; `argv[0]` is the program's own name. Every error is printed as one line
/// on standard error. Returns the exit code: 0 success, 1 a check failed, 2 the command line or an input is wrong, 3
/// not possible on this machine, 130 interrupted. Changes the process's handling of SIGPIPE, SIGXFSZ and SIGINT.
[[nodiscard]] int run_program(int argc, const char* const* argv);

}  // namespace footprint
