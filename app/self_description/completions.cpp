// One table (what an argument takes, by its name) serves the three shells; each has a writer of its own.
#include "app/self_description/completions.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "renderer/core/error.hpp"

namespace footprint {
namespace {

// What completes an argument: `footprint list KIND` where that is not empty, else files.
std::string_view listed_kind(const CommandOption& option) {
  const std::string& name = option.names.back();
  if (name == "--method" || name == "--methods") return "methods";
  if (name == "scene" || name == "--scene") return "scenes";
  if (name == "experiment") return "experiments";
  return {};
}

std::vector<std::string> named_options(const CommandPage& page) {
  std::vector<std::string> names;
  for (const CommandOption& option : page.options) {
    if (!option.positional) names.insert(names.end(), option.names.begin(), option.names.end());
  }
  return names;
}

std::vector<std::string> subcommand_names(const CommandPage& page) {
  std::vector<std::string> names;
  for (const CommandPage& subcommand : page.subcommands) names.push_back(subcommand.name);
  return names;
}

// In single quotes, for every one of the shells.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char letter : text) out += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  return out + "'";
}

// A help text's first sentence without what zsh reads as its own marks.
std::string brief(const std::string& help) {
  std::string text = help.substr(0, help.find('\n'));
  std::ranges::replace(text, '[', '(');
  std::ranges::replace(text, ']', ')');
  std::ranges::replace(text, ':', ',');
  return text;
}

// The second word of each line that starts with two spaces is no name: names stand first.
constexpr std::string_view list_command = "footprint list %s 2>/dev/null | sed -n 's/^  \\([a-z0-9_]*\\).*/\\1/p'";

std::string listing(std::string_view kind) {
  std::string command(list_command);
  return command.replace(command.find("%s"), 2, kind);
}

std::string bash_case(const CommandPage& page) {
  std::string text = fmt::format("    {})\n      options={}\n", page.name,
                                 quoted(fmt::format("{}", fmt::join(named_options(page), " "))));
  std::string positional;
  for (const CommandOption& option : page.options) {
    const std::string_view kind = listed_kind(option);
    if (kind.empty()) continue;
    if (option.positional) {
      positional = kind;
    } else {
      text += fmt::format("      if [[ $previous == {} ]]; then words=$({}); fi\n", option.names.back(), listing(kind));
    }
  }
  if (!positional.empty()) {
    text += fmt::format("      if [[ -z $words && $current != -* && $previous == {} ]]; then words=$({}); fi\n",
                        page.name, listing(positional));
  }
  return text + "      ;;\n";
}

std::string bash_script(const CommandPage& program) {
  std::string cases;
  for (const CommandPage& page : program.subcommands) cases += bash_case(page);
  const std::string commands = fmt::format("{}", fmt::join(subcommand_names(program), " "));
  const std::string options = fmt::format("{}", fmt::join(named_options(program), " "));
  return "# bash completion of " + program.name + "; written by `" + program.name + " completions bash`.\n_" +
         program.name +
         "() {\n"
         "  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} words= options=\n"
         "  case ${COMP_CWORD:-0},${COMP_WORDS[1]} in\n"
         "    1,*) mapfile -t COMPREPLY < <(compgen -W '" +
         commands + " " + options +
         "' -- \"$current\"); return ;;\n"
         "  esac\n"
         "  case ${COMP_WORDS[1]} in\n" +
         cases +
         "  esac\n"
         "  if [[ $current == -* ]]; then words=$options; fi\n"
         "  mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$current\")\n"
         "}\n"
         "complete -o default -F _" +
         program.name + " " + program.name + "\n";
}

std::string zsh_option(const CommandOption& option) {
  const std::string_view kind = listed_kind(option);
  const std::string action =
      kind.empty() ? "_files"
                   : fmt::format("{{_alternative \"{0}:{0}:($({1}))\" \"files:file:_files\"}}", kind, listing(kind));
  if (option.positional) return fmt::format("      {}", quoted(fmt::format(":{}:{}", option.names.front(), action)));
  std::vector<std::string> forms;
  for (const std::string& name : option.names) {
    const std::string value = option.value.empty() ? "" : fmt::format(":{}:{}", "value", action);
    forms.push_back("      " + quoted(fmt::format("{}[{}]{}", name, brief(option.help), value)));
  }
  return fmt::format("{}", fmt::join(forms, " \\\n"));
}

std::string zsh_script(const CommandPage& program) {
  std::string names, cases;
  for (const CommandPage& page : program.subcommands) {
    names += "    " + quoted(page.name + ":" + brief(page.summary)) + "\n";
    std::vector<std::string> options;
    for (const CommandOption& option : page.options) options.push_back(zsh_option(option));
    cases += fmt::format("    {})\n      _arguments \\\n{} ;;\n", page.name, fmt::join(options, " \\\n"));
  }
  return fmt::format(
      "#compdef {0}\n# zsh completion of {0}; written by `{0} completions zsh`.\n"
      "_{0}() {{\n  local -a commands=(\n{1}  )\n"
      "  if (( CURRENT == 2 )); then _describe command commands; return; fi\n"
      "  local command=$words[2]\n  shift words\n  (( CURRENT-- ))\n  case $command in\n{2}  esac\n}}\n"
      "_{0} \"$@\"\n",
      program.name, names, cases);
}

std::string fish_option(const std::string& program, const std::string& command, const CommandOption& option) {
  const std::string_view kind = listed_kind(option);
  std::string line = fmt::format("complete -c {} -n '__fish_seen_subcommand_from {}'", program, command);
  if (option.positional)
    return kind.empty() ? "" : fmt::format("{} -a {}\n", line, quoted(fmt::format("({})", listing(kind))));
  for (const std::string& name : option.names) {
    line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  }
  if (!option.value.empty())
    line += kind.empty() ? " -r" : fmt::format(" -x -a {}", quoted(fmt::format("({})", listing(kind))));
  return fmt::format("{} -d {}\n", line, quoted(brief(option.help)));
}

std::string fish_script(const CommandPage& program) {
  std::string text = fmt::format("# fish completion of {0}; written by `{0} completions fish`.\n", program.name);
  for (const CommandPage& page : program.subcommands) {
    text += fmt::format("complete -c {} -f -n __fish_use_subcommand -a {} -d {}\n", program.name, page.name,
                        quoted(brief(page.summary)));
    for (const CommandOption& option : page.options) text += fish_option(program.name, page.name, option);
  }
  return text;
}

}  // namespace

std::string completion_script(const CommandPage& program, std::string_view shell) {
  if (shell == "bash") return bash_script(program);
  if (shell == "zsh") return zsh_script(program);
  if (shell == "fish") return fish_script(program);
  throw Error(ErrorKind::usage, "completions", fmt::format("there are none for `{:.80}`", shell),
              "use bash, zsh or fish");
}

}  // namespace footprint
