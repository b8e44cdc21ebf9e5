// Reads both texts line by line: the sources are formatted, and so is what SPIRV-Cross writes.
#include "renderer/languages/comments.hpp"

#include <map>
#include <optional>
#include <regex>
#include <sstream>
#include <vector>

namespace footprint {
namespace {

using Comments = std::map<std::string, std::string>;  // by "name()", "struct name" and "name.member"

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

// The key of what a line without indentation begins to define.
std::optional<std::string> defined(const std::string& line) {
  static const std::regex function(R"(^\w+ (\w+)\(.*(\)|\{|\}|,)$)"), structure(R"(^struct (\w+)( \{)?$)");
  std::smatch match;
  if (std::regex_match(line, match, structure)) return "struct " + match[1].str();
  if (std::regex_match(line, match, function)) return match[1].str() + "()";
  return std::nullopt;
}

// The key of a member of `structure`.
std::optional<std::string> member(const std::string& structure, const std::string& line, std::string& comment) {
  static const std::regex declaration(R"(^\s+[\w ]+ (\w+)(\[\w+\])?;(\s*//.*)?$)");
  std::smatch match;
  if (structure.empty() || !std::regex_match(line, match, declaration)) return std::nullopt;
  comment = match[3];
  return structure + "." + match[1].str();
}

// Follows which structure a line is in.
void enter(std::string& structure, const std::string& line) {
  constexpr std::string_view word = "struct ";
  const auto key = defined(line);
  if (key && key->starts_with(word)) structure = key->substr(word.size());
  if (line.starts_with("}")) structure.clear();
}

Comments comments_of(const std::string& glsl) {
  Comments comments;
  std::string above, structure, beside;
  for (const std::string& line : lines_of(glsl)) {
    if (line.starts_with("//")) {
      above += line + "\n";
      continue;
    }
    if (const auto key = defined(line); key && !above.empty()) comments.try_emplace(*key, above);
    enter(structure, line);
    if (const auto key = member(structure, line, beside); key && !beside.empty()) comments.try_emplace(*key, beside);
    above.clear();
  }
  return comments;
}

}  // namespace

std::string with_comments(const std::string& text, const std::string& glsl) {
  Comments comments = comments_of(glsl);
  const std::vector<std::string> lines = lines_of(text);
  std::string out, structure, none, attributes;  // attributes: Metal's line above a function
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string& line = lines[i];
    if (line.starts_with("static inline __attribute__")) {
      attributes = line + "\n";
      continue;
    }
    const bool is_definition = i + 1 < lines.size() && lines[i + 1] == "{";
    const auto key = is_definition ? defined(line) : std::nullopt;
    if (const auto found = comments.find(key.value_or("")); found != comments.end()) {
      out += found->second;
      comments.erase(found);
    }
    enter(structure, line);
    const auto field = member(structure, line, none);
    const auto beside = comments.find(field.value_or(""));
    out += attributes + line + (beside == comments.end() ? "" : beside->second) + "\n";
    attributes.clear();
  }
  return out;
}

}  // namespace footprint
