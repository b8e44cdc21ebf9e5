// Parses the command line, runs one subcommand and turns every error into one line and an exit code.
#include "app/commands.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <malloc.h>

#include <csignal>
#include <exception>
#include <memory>
#include <new>
#include <system_error>

#include "app/help.hpp"
#include "app/messages.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/memory.hpp"
#include "renderer/core/names.hpp"
#include "renderer/core/process.hpp"

namespace footprint {
namespace {

constexpr const char* program_description =
    "Compares methods of specular antialiasing (normal map filtering) with a supersampled reference: error, cost and "
    "memory of each, on your own glTF model, without a display.";

constexpr const char* program_examples =
    R"(Examples:
  footprint compare model.gltf -o out          error, cost and memory of each method, images and a page
  footprint render model.gltf --method toksvig -o out.exr
  footprint check quick -o out                 run an experiment, check its claims and thresholds
  footprint recommend model.gltf -o advice     which method to use for each material
  footprint bake model.gltf --method lean -o maps
  footprint score engine.exr --reference reference.exr    an image of another renderer
  footprint list methods                       the methods and their options

Exit codes: 0 success, 1 a check failed or an image is not finite, 2 bad command line or input, 3 not possible on this machine,
130 interrupted.)";

void add_subcommands(CLI::App& app) {
  const auto add = [&app](const std::string& heading, const std::vector<void (*)(CLI::App&)>& commands) {
    const std::size_t before = app.get_subcommands({}).size();
    for (const auto& command : commands) command(app);
    const std::vector<CLI::App*> all = app.get_subcommands({});
    for (std::size_t i = before; i < all.size(); ++i) all[i]->group(heading);
  };
  add("Compare", {add_compare_command, add_recommend_command, add_score_command, add_animate_command});
  add("Look inside", {add_explain_command, add_cost_command, add_ndf_command, add_statistics_command,
                      add_render_command, add_edit_command});
  add("Export", {add_bake_command, add_shader_command, add_surface_command});
  add("Reproduce and guard", {add_run_command, add_check_command, add_merge_command});
  add("This program", {add_list_command, add_info_command, add_completions_command});
  add_colors_command(app);
  add_compile_command(app);
}

// The subcommand that was being parsed, else `app`.
const CLI::App& innermost(const CLI::App& app) {
  const std::vector<CLI::App*> parsed = app.get_subcommands();
  return parsed.empty() ? app : innermost(*parsed.front());
}

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_group().empty()) continue;  // hidden
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

std::vector<std::string> subcommand_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* subcommand : app.get_subcommands({})) names.push_back(subcommand->get_name());
  return names;
}

// "footprint compare".
std::string command_line(const CLI::App& app) {
  return app.get_parent() == nullptr ? app.get_name() : command_line(*app.get_parent()) + " " + app.get_name();
}

// The first word that no option or positional argument took; empty if every word was taken.
std::string unexpected_word(const CLI::App& app) {
  for (const std::string& word : app.remaining(true)) {
    if (word != "--") return word;
  }
  return {};
}

// The input of a command and its size: "carved_disk, --size 64x64".
std::string requested_work(const CLI::App& command) {
  std::string text;
  for (const CLI::Option* const option : command.get_options()) {
    const bool size = option->check_lname("size");
    if (option->count() == 0 || !(option->get_positional() || size)) continue;
    const std::string words = fmt::format("{}", fmt::join(option->results(), " "));
    text += fmt::format("{}{}{}", text.empty() ? "" : ", ", size ? "--size " : "", words);
  }
  return text;
}

// The error of a subcommand that threw std::bad_alloc: what it was working on, how large that is, and the memory taken.
Error memory_error(const CLI::App& app) {
  return {ErrorKind::machine, requested_work(innermost(app)), fmt::format("out of memory: {}", taken_memory_text()),
          "give a smaller --size or smaller maps, free memory, or raise its limit"};
}

// The error for what the parser threw. An unknown subcommand or option comes before what is missing because of it.
Error usage_error(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App& command = innermost(app);
  const std::string place = command.get_parent() == nullptr ? std::string{} : command.get_name();
  const std::string help = fmt::format("see `{} --help`", command_line(command));
  const std::string word = unexpected_word(app);
  if (word.empty()) return {ErrorKind::usage, place, error.what(), help};
  if (word.size() > 1 && word.front() == '-') {
    const std::string name = word.substr(0, word.find('='));
    const std::string nearest = nearest_name(name, option_names(command));
    return {ErrorKind::usage, place, fmt::format("unknown option `{}`", name),
            nearest.empty() ? help : fmt::format("did you mean `{}`? {}", nearest, help)};
  }
  const std::vector<std::string> subcommands = subcommand_names(command);
  if (subcommands.empty()) {
    return {ErrorKind::usage, place, fmt::format("unexpected argument `{}`", word), help};
  }
  return {ErrorKind::usage, place, fmt::format("unknown subcommand `{}`", word), suggestion(word, subcommands)};
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

// Lets blocks as large as a map return to the system when they are freed. By default glibc keeps freed blocks up to the
// largest size that was freed before, at most 32 MiB; that was a fifth of the peak memory of a model's maps.
void return_freed_memory_to_system() {
#ifdef __GLIBC__
  constexpr int large = 1 << 20;
  ::mallopt(M_MMAP_THRESHOLD, large);
#endif
}

int report_error(const std::string& text, ErrorKind kind) {
  write_message(text);
  return static_cast<int>(kind);
}

}  // namespace

int run_program(int argc, const char* const* argv) {
  // A closed pipe or a file over its limit becomes a failed write, which leaves nothing half-written.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  watch_interrupts();
  return_freed_memory_to_system();
  try {
    run_subcommand(argc, argv);
    return 0;
  } catch (const Error& error) {
    return report_error(error.what(), error.kind());
  } catch (const std::system_error& error) {
    const bool no_thread = error.code() == std::errc::resource_unavailable_try_again;
    return report_error(no_thread ? "cannot create a thread (raise `ulimit -u`, or end other programs)" : error.what(),
                        ErrorKind::machine);
  } catch (const std::exception& error) {
    return report_error(error.what(), ErrorKind::machine);
  }
}

}  // namespace footprint
