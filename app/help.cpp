// Translates CLI11's type names, "INT:INT in [1 - 9]" to "N (1 to 9)", and finds completions in CLI11's own tables, so
// that no option is listed twice.
#include "app/help.hpp"

#include <fmt/format.h>

#include <array>
#include <regex>
#include <sstream>
#include <utility>

#include "renderer/core/error.hpp"

namespace footprint {
namespace {

constexpr std::size_t option_column = 28, command_column = 16;

// `left`, then `text` from `column` on; below `left` if that is too long.
std::string entry(const std::string& left, const std::string& text, std::size_t column) {
  std::string out = left, line;
  if (column > 0 && left.size() + 2 > column && !text.empty()) out += "\n" + std::string(column, ' ');
  if (left.size() + 2 <= column) out += std::string(column - left.size(), ' ');
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (!line.empty() && column + line.size() + 1 + word.size() > HelpFormat::width) {
      out += line + "\n" + std::string(column, ' ');
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return out + line + "\n";
}

// "N" of "INT:INT in [1 - 9]".
std::string value_word(const CLI::Option& option) {
  const std::string word = std::regex_replace(option.get_type_name(), std::regex(R"(:(\w+ in \[.*|NONNEGATIVE)$)"), "");
  return word == "INT" || word == "UINT" ? "N" : word == "FLOAT" ? "X" : word;
}

// " (1 to 9)" of the same.
std::string range_words(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  std::smatch range;
  return std::regex_search(type, range, std::regex(R"(in \[(\S+) - (\S+)\])"))
             ? fmt::format(" ({} to {})", range[1].str(), range[2].str())
             : std::string();
}

std::string positional_words(const CLI::Option& option) {
  const std::string word = value_word(option);
  const int most = option.get_expected_max();
  const std::string all = most == 1 ? word : most == 2 ? fmt::format("{0} [{0}]", word) : word + "...";
  return option.get_required() ? all : "[" + all + "]";
}

struct Shell {
  std::string_view name, script;
};

constexpr std::array<Shell, 3> shells{{
    {"bash", R"sh(_footprint() {
  mapfile -t COMPREPLY < <(footprint completions offer -- "${COMP_WORDS[@]:1:COMP_CWORD}" 2>/dev/null | cut -f 1)
}
complete -o default -F _footprint footprint
)sh"},
    {"zsh", R"sh(#compdef footprint
_footprint() {
  local -a offered=("${(@f)$(footprint completions offer -- "${(@)words[2,CURRENT]}" 2>/dev/null)}")
  offered=(${offered//$'\t'/:})
  if (( $#offered )); then _describe footprint offered; else _files; fi
}
if [[ $funcstack[1] == _footprint ]]; then _footprint "$@"; else compdef _footprint footprint; fi
)sh"},
    {"fish", R"sh(function __footprint
  set -l words (commandline -opc)[2..] (commandline -ct)
  footprint completions offer -- $words 2>/dev/null
end
complete -c footprint -a '(__footprint)'
)sh"},
}};

// The kind of names that an option or argument takes, as `footprint list` calls it; empty: another value.
std::string_view kind_of(const CLI::Option& option) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 3> kinds{
      {{"SCENE", "scenes"}, {"EXPERIMENT", "experiments"}, {"SURFACE", "surfaces"}}};
  if (option.get_name().find("--method") != std::string::npos) return "methods";
  for (const auto& [type, kind] : kinds) {
    if (option.get_type_name() == type) return kind;
  }
  return {};
}

// The lines of the words that begin like the one that is being typed.
class Offer {
 public:
  explicit Offer(std::string typed) : typed_(std::move(typed)) {}

  void add(const std::string& word, const std::string& meaning) {
    if (word.starts_with(typed_)) text_ += word + "\t" + meaning.substr(0, meaning.find('\n')) + "\n";
  }

  void add_names(const std::vector<std::string>& names) {
    for (const std::string& name : names) add(name, "");
  }

  void add_options(const CLI::App& command) {
    for (const CLI::Option* option : command.get_options()) {
      if (option->get_group().empty()) continue;
      for (const std::string& name : option->get_snames()) add("-" + name, option->get_description());
      for (const std::string& name : option->get_lnames()) add("--" + name, option->get_description());
    }
  }

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string typed_, text_;
};

}  // namespace

HelpFormat::HelpFormat() { label("Positionals", "Arguments"); }

std::string HelpFormat::make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const {
  return std::regex_replace(Formatter::make_help(app, std::move(name), mode), std::regex("\n{3,}"), "\n\n");
}

std::string HelpFormat::make_description(const CLI::App* app) const { return entry("", app->get_description(), 0); }

std::string HelpFormat::make_usage(const CLI::App* app, std::string name) const {
  std::string usage = "\nUsage: " + name;
  if (!app->get_subcommands({}).empty()) usage += " SUBCOMMAND";
  for (const CLI::Option* option :
       app->get_options([](const CLI::Option* o) { return o->get_positional() && !o->get_group().empty(); }))
    usage += " " + positional_words(*option);
  return usage + " [OPTION]...\n";
}

std::string HelpFormat::make_option(const CLI::Option* option, bool is_positional) const {
  const bool is_flag = option->get_items_expected_max() == 0;
  std::string left = "  ", text = option->get_description() + range_words(*option);
  if (is_positional) {
    left += value_word(*option);
  } else {
    left += std::regex_replace(option->get_name(false, true), std::regex(","), ", ");
    if (!is_flag) left += " " + value_word(*option);
    if (option->get_required()) text += " (required)";
  }
  if (!is_flag && !option->get_default_str().empty()) text += "; default: " + option->get_default_str();
  return entry(left, text, option_column);
}

std::string HelpFormat::make_subcommand(const CLI::App* command) const {
  return entry("  " + command->get_name(), command->get_description(), command_column);
}

std::string completion_script(std::string_view shell) {
  for (const auto& [name, script] : shells) {
    if (name == shell) return std::string(script);
  }
  throw Error(ErrorKind::usage, "completions", "`" + std::string(shell.substr(0, 80)) + "` is not a known shell",
              "use bash, zsh or fish");
}

std::string offered_words(const CLI::App& program, std::span<const std::string> words, const NamesOf& names_of) {
  if (words.empty()) return {};
  Offer offer(words.back());
  if (words.size() == 1) {
    for (const CLI::App* command : program.get_subcommands({}))
      offer.add(command->get_name(), command->get_description());
    offer.add_options(program);
    return offer.text();
  }
  const auto named =
      program.get_subcommands([&](const CLI::App* command) { return command->check_name(words.front()); });
  if (named.empty()) return {};
  const CLI::App* command = named.front();
  const std::string& previous = words[words.size() - 2];
  const CLI::Option* option = previous.starts_with('-') ? command->get_option_no_throw(previous) : nullptr;
  if (option != nullptr && option->get_items_expected_max() > 0) {
    if (const std::string_view kind = kind_of(*option); !kind.empty()) offer.add_names(names_of(kind));
  } else if (words.back().starts_with('-')) {
    offer.add_options(*command);
  } else if (words.size() == 2) {
    for (const CLI::Option* positional :
         command->get_options([](const CLI::Option* o) { return o->get_positional(); })) {
      if (const std::string_view kind = kind_of(*positional); !kind.empty()) offer.add_names(names_of(kind));
    }
  }
  return offer.text();
}

}  // namespace footprint
