// Fills page.html: its style, its scripts, Chart.js, and the data that the scripts lay out.
#include "results/report/page.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string_view>

#include "renderer/core/embedded_texts.hpp"
#include "renderer/image/false_color.hpp"
#include "results/report/report.hpp"

namespace footprint {

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
