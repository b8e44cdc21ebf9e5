// Reads names, values and help texts out of CLI11's own tables, so that no text stands twice.
#include "app/self_description/command_tree.hpp"

#include <CLI/CLI.hpp>

namespace footprint {
namespace {

CommandOption option_of(const CLI::Option& option) {
  CommandOption told;
  told.positional = option.get_positional();
  told.required = option.get_required();
  if (told.positional) {
    told.names.push_back(option.get_name(true));
  } else {
    for (const std::string& name : option.get_snames()) told.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) told.names.push_back("--" + name);
  }
  if (option.get_items_expected_max() > 0) told.value = option.get_type_name();
  told.help = option.get_description();
  if (const std::string otherwise = option.get_default_str(); !otherwise.empty() && !told.value.empty()) {
    told.help += " (default " + otherwise + ")";
  }
  return told;
}

}  // namespace

CommandPage command_tree(const CLI::App& app) {
  CommandPage page{.name = app.get_name(),
                   .summary = app.get_description(),
                   .notes = app.get_footer(),
                   .options = {},
                   .subcommands = {}};
  for (const CLI::Option* option : app.get_options()) {
    if (!option->get_group().empty()) page.options.push_back(option_of(*option));
  }
  for (const CLI::App* subcommand : app.get_subcommands({})) {
    if (!subcommand->get_group().empty()) page.subcommands.push_back(command_tree(*subcommand));
  }
  return page;
}

}  // namespace footprint
