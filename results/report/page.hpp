// The page of a command for readers in a browser (one template, one style, one set of scripts), and markup of reports.
#pragma once

#include <initializer_list>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "results/report/figures.hpp"

namespace footprint {

struct MarkdownColumn {
  std::string title;
  bool numeric = true;  ///< aligned right
};
void fields(auto& archive, Is<MarkdownColumn> auto& value) {
  archive("title", value.title);
  archive("numeric", value.numeric);
}

/// `text` with the characters that mean something in Markdown or HTML escaped, line breaks as spaces.
[[nodiscard]] std::string markdown_escaped(const std::string& text);

/// A table with its heading.
struct Table {
  std::string heading = {};
  std::vector<MarkdownColumn> columns = {};
  std::vector<std::vector<std::string>> rows = {};  ///< one cell per column
};
void fields(auto& archive, Is<Table> auto& value) {
  archive("heading", value.heading);
  archive("columns", value.columns);
  archive("rows", value.rows);
}

/// The table under its heading, every cell escaped; empty without rows.
[[nodiscard]] std::string html_table(const Table& table);

/// The table without its heading, every cell escaped.
[[nodiscard]] std::string markdown_table(const Table& table);

/// The table below its heading, of a level; empty without rows.
[[nodiscard]] std::string markdown_section(const Table& table, int level = 2);

/// `page` with every `{{name}}` replaced by its value; values are not searched again. Throws std::logic_error for a
/// name without a value: template and program belong together.
[[nodiscard]] std::string fill_template(std::string_view page, const std::map<std::string, std::string_view>& values);

/// `text` with characters replaced.
[[nodiscard]] std::string escaped(std::string_view text,
                                  std::initializer_list<std::pair<char, std::string_view>> escapes);

/// `text` for use as HTML content or in a quoted attribute.
[[nodiscard]] std::string html_escaped(std::string_view text);

/// JSON text for use inside a <script> element: `<`, which is only in strings, becomes \u003c, so that no
/// `</script>` or `<!--` ends the element early.
[[nodiscard]] std::string script_escaped(std::string_view json);

/// An image of the comparator. Paths are relative to the page.
struct PageImage {
  std::string name;
  std::string png;                    ///< as displayed
  std::string values = {};            ///< script with its values (renderer/image/pixel_script.hpp); empty: none
  std::string error = {}, flip = {};  ///< maps against the first image of the view, PNG; empty: none
  std::string caption = {};
};
void fields(auto& archive, Is<PageImage> auto& value) {
  archive("name", value.name);
  archive("png", value.png);
  archive("values", value.values);
  archive("error", value.error);
  archive("flip", value.flip);
  archive("caption", value.caption);
}

/// The images of one view, at least one; the first is the reference.
struct PageView {
  std::string label;
  std::vector<PageImage> images;
};
void fields(auto& archive, Is<PageView> auto& value) {
  archive("label", value.label);
  archive("images", value.images);
}

/// A candidate in a plot of error against cost.
struct PagePoint {
  std::string name;
  double x = 0, low = 0, high = 0;  ///< its cost, with the spread
  double y = 0;                     ///< its error
  bool chosen = false;
};
void fields(auto& archive, Is<PagePoint> auto& value) {
  archive("name", value.name);
  archive("x", value.x);
  archive("low", value.low);
  archive("high", value.high);
  archive("y", value.y);
  archive("chosen", value.chosen);
}

/// Error against cost, on logarithmic axes.
struct PagePlot {
  std::string title;  ///< of the cost
  std::vector<PagePoint> points = {};
  std::optional<double> most_x = {}, most_y = {};  ///< limits, drawn as lines
};
void fields(auto& archive, Is<PagePlot> auto& value) {
  archive("title", value.title);
  archive("points", value.points);
  archive("most_x", value.most_x);
  archive("most_y", value.most_y);
}

/// A section of its own: what it has of these, in this order.
struct PageSection {
  std::string heading;
  std::vector<std::string> sentences = {};
  std::string command = {};  ///< to copy
  PagePlot plot = {};
  Table table = {};                        ///< its own heading is not shown
  std::optional<std::size_t> marked = {};  ///< row of the table
  std::vector<std::string> links = {};     ///< pages, relative to this one
};
void fields(auto& archive, Is<PageSection> auto& value) {
  archive("heading", value.heading);
  archive("sentences", value.sentences);
  archive("command", value.command);
  archive("plot", value.plot);
  archive("table", value.table);
  archive("marked", value.marked);
  archive("links", value.links);
}

struct Page {
  std::string title, eyebrow = {}, lede = {};
  std::string text;                      ///< for readers without scripts
  std::vector<std::string> answer = {};  ///< sentences, the most important first
  std::vector<PageView> views = {};
  std::vector<std::string> shown = {};  ///< images on the first screen, the best last; empty: the first three
  bool in_false_color = false;          ///< images are maps of one figure: nothing is exposed, and they have no FLIP
  double exposure = 1;                  ///< from radiance to displayed values
  std::vector<PageSection> sections = {};
  std::vector<Provenance> provenance = {};
  std::string experiment = {}, gpus = {};  ///< HTML
};

/// The page, whole and self-contained but for the images beside it and their values.
/// own: further data for the scripts, an object; its keys replace those of the page.
[[nodiscard]] std::string page_html(const Page& page,
                                    const nlohmann::ordered_json& own = nlohmann::ordered_json::object());

}  // namespace footprint
