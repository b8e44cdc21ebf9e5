// Fills page.html: its style, its scripts, Chart.js, and the data that the scripts lay out.
#include "results/report/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>

#include "renderer/core/embedded_texts.hpp"
#include "renderer/image/false_color.hpp"
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

Json views_json(const std::vector<PageView>& views) {
  Json list = Json::array();
  for (const PageView& view : views) {
    Json images = Json::array();
    for (const PageImage& image : view.images) {
      images.push_back({{"name", image.name},
                        {"png", image.png},
                        {"values", image.values},
                        {"error", image.error},
                        {"flip", image.flip},
                        {"caption", image.caption}});
    }
    list.push_back({{"label", view.label}, {"images", std::move(images)}});
  }
  return list;
}

Json plot_json(const PagePlot& plot) {
  Json points = Json::array();
  for (const PagePoint& p : plot.points) {
    points.push_back(
        {{"name", p.name}, {"x", p.cost}, {"low", p.low}, {"high", p.high}, {"y", p.error}, {"chosen", p.is_chosen}});
  }
  return {{"title", plot.cost_title},
          {"points", std::move(points)},
          {"most_x", json_number(plot.most_cost)},
          {"most_y", json_number(plot.most_error)}};
}

Json table_json(const Table& table) {
  Json columns = Json::array();
  for (const MarkdownColumn& column : table.columns)
    columns.push_back({{"title", column.title}, {"words", !column.numeric}});
  return {{"columns", std::move(columns)}, {"rows", table.rows}};
}

Json sections_json(const std::vector<PageSection>& sections) {
  Json list = Json::array();
  for (const PageSection& section : sections) {
    list.push_back({{"heading", section.heading},
                    {"sentences", section.sentences},
                    {"command", section.command},
                    {"plot", plot_json(section.plot)},
                    {"table", table_json(section.table)},
                    {"marked", section.marked_row ? Json(*section.marked_row) : Json(nullptr)},
                    {"links", section.links}});
  }
  return list;
}

}  // namespace

std::string page_html(const Page& page) { return page_html(page, Json::object()); }

std::string page_html(const Page& page, const nlohmann::ordered_json& own) {
  Json data{{"answer", page.answer},
            {"lede", page.lede},
            {"exposure", page.exposure},
            {"in_false_color", page.in_false_color},
            {"views", views_json(page.views)},
            {"shown", page.shown},
            {"sections", sections_json(page.sections)},
            {"provenance", Json::array()},
            {"palette", Json::parse(find_text(page_texts, "palette.json")->text)},
            {"scale_colors", scale_colors()}};
  for (const Provenance& line : page.provenance)
    data["provenance"].push_back({{"label", line.label}, {"value", line.value}});
  data.update(own);
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
