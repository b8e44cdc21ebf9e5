// Finds the word that the parser stumbled over, and the nearest one that it would have taken; or what was asked for.
#include "app/parse_error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/core/memory.hpp"
#include "renderer/core/suggest.hpp"

namespace footprint {
namespace {

// The subcommand that was being parsed, or `app` itself.
const CLI::App& innermost(const CLI::App& app) {
  const std::vector<CLI::App*> parsed = app.get_subcommands();
  return parsed.empty() ? app : innermost(*parsed.front());
}

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_group().empty()) continue;  // not for people
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

// Where to read on: "footprint compare --help".
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

// What the command works on, and how large: "carved_disk, --size 64x64".
std::string asked_work(const CLI::App& command) {
  std::string text;
  for (const CLI::Option* const option : command.get_options()) {
    const bool size = option->check_lname("size");
    if (option->count() == 0 || !(option->get_positional() || size)) continue;
    const std::string words = fmt::format("{}", fmt::join(option->results(), " "));
    text += fmt::format("{}{}{}", text.empty() ? "" : ", ", size ? "--size " : "", words);
  }
  return text;
}

}  // namespace

Error memory_error(const CLI::App& app) {
  return {ErrorKind::machine, asked_work(innermost(app)), fmt::format("out of memory: {}", taken_memory_text()),
          "ask for a smaller --size or smaller maps, free memory, or raise its limit"};
}

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

}  // namespace footprint
