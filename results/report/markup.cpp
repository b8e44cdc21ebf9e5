// Pads and escapes the cells of tables, and fills names in templates.
#include "results/report/markup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <string_view>

namespace footprint {
namespace {

/// Columns that UTF-8 text takes in a terminal: code points, which is right for all but wide scripts.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U; }));
}

std::string padded(const std::string& text, std::size_t width, bool right) {
  const std::string gap(width - std::min(width, width_of(text)), ' ');
  return right ? gap + text : text + gap;
}

std::string row_text(const std::vector<std::string>& cells, const std::vector<std::size_t>& widths,
                     const std::vector<MarkdownColumn>& columns) {
  std::string line = "|";
  for (std::size_t i = 0; i < columns.size(); ++i) {
    line.append(" ").append(padded(cells[i], widths[i], columns[i].numeric)).append(" |");
  }
  return line + "\n";
}

/// Whether Markdown would take the character for more than itself: "a <b" opens a tag, "<1" and a free " *" do not.
bool means_something(std::string_view text, std::size_t i) {
  const char next = i + 1 < text.size() ? text[i + 1] : ' ';
  const char previous = i > 0 ? text[i - 1] : ' ';
  const bool before_word = std::isalpha(static_cast<unsigned char>(next)) != 0;
  switch (text[i]) {
    case '\\':
    case '`':
    case '|':
    case '[':
      return true;
    case '*':
      return next != ' ' || previous != ' ';
    case '<':
      return before_word || next == '/' || next == '!' || next == '?';
    case '&':
      return before_word || next == '#';
    default:
      return false;
  }
}

}  // namespace

std::string markdown_escaped(const std::string& text) {
  std::string escaped;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (means_something(text, i)) escaped += '\\';
    escaped += text[i] == '\n' || text[i] == '\r' ? ' ' : text[i];
  }
  return escaped;
}

std::string markdown_table(const std::vector<MarkdownColumn>& columns,
                           const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::string> titles;
  std::vector<std::size_t> widths;
  for (const MarkdownColumn& column : columns) {
    titles.push_back(column.title);
    widths.push_back(std::max<std::size_t>(width_of(column.title), 3));
  }
  std::vector<std::vector<std::string>> cells = rows;
  for (std::vector<std::string>& row : cells) {
    for (std::size_t i = 0; i < columns.size(); ++i) {
      row[i] = markdown_escaped(row[i]);
      widths[i] = std::max(widths[i], width_of(row[i]));
    }
  }
  std::string text = row_text(titles, widths, columns) + "|";
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const std::string dashes(widths[i] + 1, '-');
    text.append(columns[i].numeric ? "" : ":").append(dashes).append(columns[i].numeric ? ":|" : "|");
  }
  text += "\n";
  for (const std::vector<std::string>& row : cells) text += row_text(row, widths, columns);
  return text;
}

std::string html_table(const Table& table) {
  if (table.rows.empty()) return {};
  std::string html = fmt::format("<h3>{}</h3>\n<div class=\"scroll\"><table><thead><tr>", html_escaped(table.heading));
  const auto cell = [&](const char* tag, std::size_t column, const std::string& text) {
    return fmt::format("<{0}{1}>{2}</{0}>", tag, table.columns[column].numeric ? "" : " class=\"words-column\"",
                       html_escaped(text));
  };
  for (std::size_t i = 0; i < table.columns.size(); ++i) html += cell("th", i, table.columns[i].title);
  html += "</tr></thead><tbody>\n";
  for (const std::vector<std::string>& row : table.rows) {
    html += "<tr>";
    for (std::size_t i = 0; i < row.size(); ++i) html += cell("td", i, row[i]);
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string fill_template(std::string_view page, const std::map<std::string, std::string_view>& values) {
  std::string filled;
  for (;;) {
    const std::size_t open = page.find("{{");
    const std::size_t close = open == std::string_view::npos ? open : page.find("}}", open);
    if (close == std::string_view::npos) return filled.append(page);
    const std::string name(page.substr(open + 2, close - open - 2));
    const auto value = values.find(name);
    if (value == values.end()) throw std::logic_error("the page's template names `" + name + "`");
    filled.append(page.substr(0, open)).append(value->second);
    page.remove_prefix(close + 2);
  }
}

std::string html_escaped(std::string_view text) {
  std::string escaped;
  for (const char character : text) {
    switch (character) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\'':
        escaped += "&#39;";
        break;
      default:
        escaped += character;
    }
  }
  return escaped;
}

std::string script_escaped(std::string_view json) {
  std::string escaped;
  escaped.reserve(json.size());
  for (const char character : json) {
    if (character == '<') {
      escaped += "\\u003c";
    } else {
      escaped += character;
    }
  }
  return escaped;
}

}  // namespace footprint
