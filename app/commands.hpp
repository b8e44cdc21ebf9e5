// The subcommands of `footprint`.
#pragma once

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
void add_surface_command(CLI::App& app);
void add_info_command(CLI::App& app);
void add_cost_command(CLI::App& app);
void add_compile_command(CLI::App& app);
void add_completions_command(CLI::App& app);

}  // namespace footprint
