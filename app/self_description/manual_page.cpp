// Roff from a command tree. A line of text must not start with a dot or an apostrophe, and a backslash is written \e.
#include "app/self_description/manual_page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <sstream>

namespace footprint {
namespace {

std::string escaped(const std::string& text) {
  std::string out;
  bool line_start = true;
  for (const char letter : text) {
    if (line_start && (letter == '.' || letter == '\'')) out += "\\&";
    line_start = letter == '\n';
    if (letter == '\\') {
      out += "\\e";
    } else if (letter == '-') {
      out += "\\-";
    } else {
      out += letter;
    }
  }
  return out;
}

std::string upper(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char letter) { return std::toupper(letter); });
  return text;
}

std::string option_text(const CommandOption& option) {
  const std::string names =
      option.positional ? upper(option.names.front()) : fmt::format("{}", fmt::join(option.names, ", "));
  const std::string value =
      option.positional || option.value.empty() ? "" : fmt::format(" \\fI{}\\fR", escaped(option.value));
  return fmt::format(".TP\n\\fB{}\\fR{}\n{}\n", escaped(names), value, escaped(option.help));
}

// Lines with two spaces before them are examples, set as they are; others are paragraphs.
std::string notes_text(const std::string& notes) {
  std::string text = notes.empty() ? "" : ".PP\n";
  bool example = false;
  std::istringstream lines(notes);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("  ") != example) text += example ? ".EE\n" : ".EX\n";
    example = line.starts_with("  ");
    text += line.empty() ? ".PP\n" : escaped(line) + "\n";
  }
  return text + (example ? ".EE\n" : "");
}

std::string synopsis(const std::string& program, const CommandPage& page) {
  std::string line = fmt::format("\\fB{} {}\\fR", program, escaped(page.name));
  for (const CommandOption& option : page.options) {
    if (!option.positional) continue;
    const std::string name = upper(option.names.front());
    line += option.required ? " " + name : " [" + name + "]";
  }
  return line + " [\\fIOPTION\\fR]...\n";
}

std::string command_text(const std::string& program, const CommandPage& page) {
  std::string text =
      fmt::format(".SS {}\n{}.PP\n{}.\n", escaped(page.name), synopsis(program, page), escaped(page.summary));
  for (const CommandOption& option : page.options) text += option_text(option);
  return text + notes_text(page.notes);
}

constexpr std::string_view files =
    ".SH FILES\n"
    ".TP\n\\fI$FOOTPRINT_CACHE, $XDG_CACHE_HOME/footprint, ~/.cache/footprint\\fR\n"
    "Cache of slow bakes: the first of these that is set.\n"
    ".SH ENVIRONMENT\n"
    ".TP\n\\fBFOOTPRINT_SCENES\\fR, \\fBFOOTPRINT_EXPERIMENTS\\fR\n"
    "Folders of scenes and experiments, instead of the installed ones.\n";

}  // namespace

std::string manual_page(const CommandPage& program, const std::string& version) {
  std::string text =
      fmt::format(".TH {} 1 \"\" \"{} {}\" \"User Commands\"\n", upper(program.name), program.name, version);
  text +=
      fmt::format(".SH NAME\n{} \\- compares methods of specular antialiasing (normal map filtering)\n", program.name);
  text += fmt::format(".SH SYNOPSIS\n\\fB{}\\fR \\fICOMMAND\\fR [\\fIARGUMENT\\fR]...\n", program.name);
  text += fmt::format(".SH DESCRIPTION\n{}\n", escaped(program.summary)) + notes_text(program.notes);
  text += ".SH OPTIONS\n";
  for (const CommandOption& option : program.options) text += option_text(option);
  text += ".SH COMMANDS\n";
  for (const CommandPage& page : program.subcommands) text += command_text(program.name, page);
  return text + std::string(files);
}

}  // namespace footprint
