// Wraps words into lines, and translates CLI11's type names: "INT:INT in [1 - 9]" to "N (1 to 9)".
#include "app/help_format.hpp"

#include <fmt/format.h>

#include <regex>
#include <sstream>

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

}  // namespace footprint
