// Parses the command line, runs one subcommand and turns every error into one line and an exit code.
#include "app/program.hpp"

#include <malloc.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <system_error>
#include <vector>

#include "app/commands.hpp"
#include "app/help_format.hpp"
#include "app/messages.hpp"
#include "app/parse_error.hpp"
#include "app/standard_output.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/interrupt.hpp"

namespace footprint {
namespace {

constexpr const char* program_description =
    "Compares methods of specular antialiasing (normal map filtering) with a supersampled reference: error, cost and "
    "memory of each, on your own glTF model, without a display.";

constexpr const char* program_examples =
    "Examples:\n"
    "  footprint compare model.gltf -o out          error, cost and memory of each method, images and a page\n"
    "  footprint render model.gltf --method toksvig -o out.exr\n"
    "  footprint check quick -o out                 run an experiment, check its claims and thresholds\n"
    "  footprint recommend model.gltf -o advice     which method to use for each material\n"
    "  footprint bake model.gltf --method lean -o maps\n"
    "  footprint score engine.exr --reference reference.exr    an image of another renderer\n"
    "  footprint list methods                       the methods and their options\n"
    "\n"
    "Exit codes: 0 success, 1 a check failed, 2 bad command line or input, 3 not possible on this machine,\n"
    "130 interrupted.";

// Subcommands under the heading of what they are for.
void add_subcommands(CLI::App& app) {
  const auto add = [&app](const std::string& heading, const std::vector<void (*)(CLI::App&)>& commands) {
    const std::size_t before = app.get_subcommands({}).size();
    for (const auto& command : commands) command(app);
    const std::vector<CLI::App*> all = app.get_subcommands({});
    for (std::size_t i = before; i < all.size(); ++i) all[i]->group(heading);
  };
  add("Compare", {add_compare_command, add_recommend_command, add_score_command, add_animate_command});
  add("Look inside", {add_explain_command, add_ndf_command, add_render_command, add_edit_command});
  add("Export", {add_bake_command, add_surface_command});
  add("Reproduce and guard", {add_run_command, add_check_command, add_merge_command});
  add("This program", {add_list_command, add_info_command, add_completions_command, add_manual_command});
}

void run_subcommand(int argc, const char* const* argv) {
  CLI::App app(program_description, "footprint");
  app.formatter(std::make_shared<HelpFormat>());
  app.footer(program_examples);
  app.set_version_flag("--version", "footprint " FOOTPRINT_VERSION, "Print the version and exit");
  app.require_subcommand(0, 1);
  add_subcommands(app);
  try {
    app.parse(argc, argv);
    if (app.get_subcommands().empty()) write_output(app.help());
  } catch (const CLI::CallForHelp&) {
    write_output(app.help());  // of the subcommand, where one is named
  } catch (const CLI::CallForVersion& version) {
    write_output(std::string(version.what()) + "\n");
  } catch (const CLI::ParseError& error) {
    throw usage_error(app, error);
  } catch (const std::bad_alloc&) {
    throw memory_error(app);
  }
}

// What is as large as a map goes back to the system when it is freed: glibc on its own keeps what is freed below the
// largest size that it has seen go, up to 32 MiB, and a fifth of the peak of a model's maps was that.
void give_back_what_is_freed() {
#ifdef __GLIBC__
  constexpr int large = 1 << 20;
  ::mallopt(M_MMAP_THRESHOLD, large);
#endif
}

int told(const std::string& text, ErrorKind kind) {
  write_message(text);
  return static_cast<int>(kind);
}

}  // namespace

int run_program(int argc, const char* const* argv) {
  // A closed pipe and a file over its limit come back as failed writes, which leave nothing half-written.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  watch_interrupts();
  give_back_what_is_freed();
  try {
    run_subcommand(argc, argv);
    return 0;
  } catch (const Error& error) {
    return told(error.what(), error.kind());
  } catch (const std::system_error& error) {
    const bool no_thread = error.code() == std::errc::resource_unavailable_try_again;
    return told(no_thread ? "this machine cannot start another thread (raise `ulimit -u`, or end other programs)"
                          : error.what(),
                ErrorKind::machine);
  } catch (const std::exception& error) {
    return told(error.what(), ErrorKind::machine);
  }
}

}  // namespace footprint
