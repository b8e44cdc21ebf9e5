// `footprint completions` and `footprint manual`: what the program knows of its own command line, for shells and man.
#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "app/commands.hpp"
#include "app/self_description/command_tree.hpp"
#include "app/self_description/completions.hpp"
#include "app/self_description/manual_page.hpp"
#include "app/standard_output.hpp"

namespace footprint {
namespace {

constexpr const char* completion_examples =
    "Installed packages bring these already.\n"
    "\n"
    "Examples:\n"
    "  source <(footprint completions bash)\n"
    "  footprint completions zsh > ~/.zfunc/_footprint\n"
    "  footprint completions fish > ~/.config/fish/completions/footprint.fish";

constexpr const char* manual_examples =
    "Examples:\n"
    "  footprint manual > footprint.1 && man ./footprint.1";

}  // namespace

void add_completions_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("completions", "Print the completions of the command line for a shell");
  const auto shell = std::make_shared<std::string>();
  command->add_option("shell", *shell, "bash, zsh or fish")->type_name("SHELL")->required();
  command->footer(completion_examples);
  command->callback([shell, &app] { write_output(completion_script(command_tree(app), *shell)); });
}

void add_manual_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("manual", "Print the manual page in roff");
  command->footer(manual_examples);
  command->callback([&app] { write_output(manual_page(command_tree(app), FOOTPRINT_VERSION)); });
}

}  // namespace footprint
