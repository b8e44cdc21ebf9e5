// Fills page.html: its style, its scripts, Chart.js, and the data that the scripts lay out.
#include "results/report/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <stdexcept>

#include "renderer/core/embedded_texts.hpp"
#include "renderer/image/false_color.hpp"
#include "results/report/json_archive.hpp"
#include "results/report/method_colors.hpp"
#include "results/report/report.hpp"

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
  if (text[i] == '*') return next != ' ' || previous != ' ';
  if (text[i] == '<') return before_word || next == '/' || next == '!' || next == '?';
  if (text[i] == '&') return before_word || next == '#';
  return std::string_view("\\`|[").find(text[i]) != std::string_view::npos;
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

std::string markdown_table(const Table& table) {
  const auto& [heading, columns, rows] = table;
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

std::string markdown_section(const Table& table, int level) {
  if (table.rows.empty()) return {};
  return fmt::format("\n{:#<{}} {}\n\n{}", "", level, table.heading, markdown_table(table));
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

std::string escaped(std::string_view text, std::initializer_list<std::pair<char, std::string_view>> escapes) {
  std::string out;
  out.reserve(text.size());
  for (const char character : text) {
    const auto* escape = std::ranges::find(escapes, character, &std::pair<char, std::string_view>::first);
    if (escape != escapes.end()) {
      out += escape->second;
    } else {
      out += character;
    }
  }
  return out;
}

std::string html_escaped(std::string_view text) {
  return escaped(text, {{'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}, {'\'', "&#39;"}});
}

std::string script_escaped(std::string_view json) { return escaped(json, {{'<', "\\u003c"}}); }

extern const EmbeddedTexts page_texts;

namespace {

using Json = nlohmann::ordered_json;

// In the order in which they use each other's names.
constexpr std::array<std::string_view, 5> page_scripts{"page.js", "plots.js", "table.js", "path.js", "comparator.js"};

/// The false-colour scale as colours at even steps: [0, 0, 4], ...
Json scale_colors() {
  constexpr int steps = 256;
  Image ramp(steps, 1, 1);
  for (int x = 0; x < steps; ++x) ramp.at(x, 0)[0] = static_cast<float>(x) / (steps - 1);
  const Image colors = false_color(ramp, 1.0F);
  Json list = Json::array();
  for (int x = 0; x < steps; ++x) {
    const std::span<const float> rgb = colors.at(x, 0);
    const auto byte = [&rgb](std::size_t channel) { return std::lround(rgb[channel] * 255.0F); };
    list.push_back({byte(0), byte(1), byte(2)});
  }
  return list;
}

/// The methods of a page: of the records of its runs or, without runs, of the images of its views after the reference.
std::vector<std::string> methods_on(const Json& data) {
  std::vector<std::string> methods;
  const auto add = [&](const std::string& name) {
    if (std::ranges::find(methods, name) == methods.end()) methods.push_back(name);
  };
  if (const auto runs = data.find("runs"); runs != data.end() && !runs->empty()) {
    for (const Json& run : *runs) {
      for (const Json& record : run.at("results").at("records")) add(record.at("method").get<std::string>());
    }
    return methods;
  }
  for (const Json& view : data.at("views")) {
    const Json& images = view.at("images");
    for (std::size_t i = 1; i < images.size(); ++i) add(images[i].at("name").get<std::string>());
  }
  return methods;
}

/// {method: the place of its colour}.
Json places_of_colors(const std::vector<std::string>& methods) {
  const std::vector<std::size_t> places = color_places(methods);
  Json json = Json::object();
  for (std::size_t i = 0; i < methods.size(); ++i) json[methods[i]] = places[i];
  return json;
}

}  // namespace

void fields(JsonWriter& archive, const Page& value) {
  archive("answer", value.answer);
  archive("lede", value.lede);
  archive("exposure", value.exposure);
  archive("in_false_color", value.in_false_color);
  archive("views", value.views);
  archive("shown", value.shown);
  archive("sections", value.sections);
  archive("provenance", value.provenance);
  archive("palette", Json{{"light", report_palette().light}, {"dark", report_palette().dark}});
  archive("scale_colors", scale_colors());
}

std::string page_html(const Page& page, const nlohmann::ordered_json& own) {
  Json data = to_json_value(page);
  data.update(own);
  data["color_places"] = places_of_colors(methods_on(data));
  std::string scripts;
  for (const std::string_view file : page_scripts) {
    scripts += fmt::format("<script>\n{}</script>\n", find_text(page_texts, file)->text);
  }
  const std::string filled = script_escaped(json_text(data, -1)), title = html_escaped(page.title),
                    eyebrow = html_escaped(page.eyebrow), text = html_escaped(page.text);
  return fill_template(find_text(page_texts, "page.html")->text,
                       {{"title", title},
                        {"eyebrow", eyebrow},
                        {"text", text},
                        {"css", find_text(page_texts, "page.css")->text},
                        {"chart", find_text(page_texts, "chart.min.js")->text},
                        {"scripts", scripts},
                        {"experiment", page.experiment},
                        {"gpus", page.gpus},
                        {"data", filled}});
}

}  // namespace footprint
