// Parses the command line, runs one subcommand and turns every error into one line and an exit code.
#include "app/program.hpp"

#include <malloc.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <exception>
#include <new>
#include <string>
#include <system_error>

#include "app/commands.hpp"
#include "app/messages.hpp"
#include "app/parse_error.hpp"
#include "app/standard_output.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/interrupt.hpp"

namespace footprint {
namespace {

constexpr const char* program_description =
    "Renders shiny, bumpy surfaces headlessly and compares the methods that prefilter them with a supersampled "
    "reference: what each costs, and what error is left.";

constexpr const char* program_examples =
    "Examples:\n"
    "  footprint compare model.gltf -o out          the error and fps table, pictures and a page\n"
    "  footprint render model.gltf --method toksvig -o out.exr\n"
    "  footprint check quick -o out                 an experiment with its claims held\n"
    "  footprint recommend model.gltf -o advice     which method to take for each material\n"
    "  footprint bake model.gltf --method lean -o maps\n"
    "  footprint score engine.exr --reference reference.exr    another renderer's picture\n"
    "  footprint list methods                       the methods and their options\n"
    "\n"
    "Exit codes: 0 fine, 1 a check fell short, 2 the command line or an input is wrong, 3 the machine cannot,\n"
    "130 interrupted.";

void run_subcommand(int argc, const char* const* argv) {
  CLI::App app(program_description, "footprint");
  app.footer(program_examples);
  app.set_version_flag("--version", "footprint " FOOTPRINT_VERSION);
  app.require_subcommand(1);
  add_compare_command(app);
  add_recommend_command(app);
  add_render_command(app);
  add_animate_command(app);
  add_edit_command(app);
  add_run_command(app);
  add_check_command(app);
  add_merge_command(app);
  add_bake_command(app);
  add_explain_command(app);
  add_ndf_command(app);
  add_score_command(app);
  add_list_command(app);
  add_surface_command(app);
  add_info_command(app);
  add_completions_command(app);
  add_manual_command(app);
  try {
    app.parse(argc, argv);
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
    return told(
        no_thread ? "this machine gives no further thread (raise `ulimit -u`, or end other programs)" : error.what(),
        ErrorKind::machine);
  } catch (const std::exception& error) {
    return told(error.what(), ErrorKind::machine);
  }
}

}  // namespace footprint
