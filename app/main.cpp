// The program: parses the command line, runs one subcommand and turns every error into one line and an exit code.
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

namespace {

constexpr const char* description =
    "Renders shiny, bumpy surfaces headlessly and compares the methods that prefilter them with a supersampled "
    "reference: what each costs, and what error is left.";

constexpr const char* examples =
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

void run(int argc, const char* const* argv) {
  CLI::App app(description, "footprint");
  app.footer(examples);
  app.set_version_flag("--version", "footprint " FOOTPRINT_VERSION);
  app.require_subcommand(1);
  footprint::add_compare_command(app);
  footprint::add_recommend_command(app);
  footprint::add_render_command(app);
  footprint::add_animate_command(app);
  footprint::add_edit_command(app);
  footprint::add_run_command(app);
  footprint::add_check_command(app);
  footprint::add_merge_command(app);
  footprint::add_bake_command(app);
  footprint::add_explain_command(app);
  footprint::add_ndf_command(app);
  footprint::add_score_command(app);
  footprint::add_list_command(app);
  footprint::add_surface_command(app);
  footprint::add_info_command(app);
  footprint::add_completions_command(app);
  footprint::add_manual_command(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    footprint::write_output(app.help());  // of the subcommand, where one is named
  } catch (const CLI::CallForVersion& version) {
    footprint::write_output(std::string(version.what()) + "\n");
  } catch (const CLI::ParseError& error) {
    throw footprint::usage_error(app, error);
  }
}

int fail(const std::string& text, footprint::ErrorKind kind) {
  footprint::write_message(text);
  return static_cast<int>(kind);
}

}  // namespace

int main(int argc, char** argv) {
  using footprint::ErrorKind;
  // A closed pipe and a file over its limit come back as failed writes, which leave nothing half-written.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  footprint::watch_interrupts();
  try {
    run(argc, argv);
    return 0;
  } catch (const footprint::Error& error) {
    return fail(error.what(), error.kind());
  } catch (const std::bad_alloc&) {
    return fail("out of memory (ask for a smaller --size, or free memory)", ErrorKind::machine);
  } catch (const std::system_error& error) {
    const bool no_thread = error.code() == std::errc::resource_unavailable_try_again;
    return fail(
        no_thread ? "this machine gives no further thread (raise `ulimit -u`, or end other programs)" : error.what(),
        ErrorKind::machine);
  } catch (const std::exception& error) {
    return fail(error.what(), ErrorKind::machine);
  }
}
