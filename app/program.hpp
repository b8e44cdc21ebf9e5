// The whole program as a function.
#pragma once

namespace footprint {

/// Runs the subcommand that the arguments name, `argv[0]` the program's own name; every error has been told in one line
/// on standard error when it returns. Returns the exit code: 0 fine, 1 a check fell short, 2 the command line or an
/// input is wrong, 3 the machine cannot, 130 interrupted. Changes how the process takes SIGPIPE, SIGXFSZ and SIGINT.
[[nodiscard]] int run_program(int argc, const char* const* argv);

}  // namespace footprint
