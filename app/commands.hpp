// The subcommands of `footprint`, the whole program as a function, and `footprint check hard_cases`: every method in
// numerically hard cases.
#pragma once

#include <string>
#include <string_view>

#include "experiments/settings/run_settings.hpp"

namespace CLI {
class App;
}

namespace footprint {

// Each adds its subcommand to `app`; the work is done when the whole command line has been parsed. Errors are thrown.
void add_compare_command(CLI::App& app);
void add_recommend_command(CLI::App& app);
void add_render_command(CLI::App& app);
void add_run_command(CLI::App& app);
void add_check_command(CLI::App& app);
void add_merge_command(CLI::App& app);
void add_animate_command(CLI::App& app);
void add_edit_command(CLI::App& app);
void add_bake_command(CLI::App& app);
void add_explain_command(CLI::App& app);
void add_list_command(CLI::App& app);
void add_ndf_command(CLI::App& app);
void add_score_command(CLI::App& app);
void add_shader_command(CLI::App& app);
void add_statistics_command(CLI::App& app);
void add_surface_command(CLI::App& app);
void add_info_command(CLI::App& app);
void add_cost_command(CLI::App& app);
void add_colors_command(CLI::App& app);
void add_compile_command(CLI::App& app);
void add_completions_command(CLI::App& app);

/// Runs the subcommand that the arguments name; `argv[0]` is the program's own name. Every error is printed as one line
/// on standard error. Returns the exit code: 0 success, 1 a check failed, 2 the command line or an input is wrong, 3
/// not possible on this machine, 130 interrupted. Changes the process's handling of SIGPIPE, SIGXFSZ and SIGINT.
[[nodiscard]] int run_program(int argc, const char* const* argv);

/// The word on the command line instead of an experiment's name.
inline constexpr std::string_view hard_cases_name = "hard_cases";

struct HardCasesRequest {
  RunSettings run;     ///< only its backend and methods count
  bool wide = false;   ///< also every storage in every case, and slow cases
  std::string output;  ///< folder; overwritten as a whole
  bool quiet = false;  ///< no progress on standard error
};

/// Writes stability.md, hard_cases.json and images of the failures into the output folder. tests/hard_cases/ defines
/// it; a program built with FOOTPRINT_TESTS=OFF has no hard cases. Errors: check, naming the first failure, after the
/// files are written; usage, in a program without hard cases.
void check_hard_cases(const HardCasesRequest& request);

}  // namespace footprint
