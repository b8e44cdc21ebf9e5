// Finds the words in CLI11's own tables, so that no option is listed twice.
#include "app/completions.hpp"

#include <CLI/CLI.hpp>
#include <array>
#include <utility>

#include "renderer/core/error.hpp"

namespace footprint {
namespace {

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
