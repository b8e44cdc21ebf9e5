// Results as one page that opens from disk: page.html with its style, its script, Chart.js and the data filled in.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "renderer/core/embedded_texts.hpp"
#include "renderer/core/memory.hpp"
#include "renderer/image/false_color.hpp"
#include "results/report/experiment_section.hpp"
#include "results/report/figures.hpp"
#include "results/report/report.hpp"
#include "results/report/results_document.hpp"
#include "results/report/text_template.hpp"

namespace footprint {
namespace embedded {
extern const EmbeddedTexts page_texts;
}  // namespace embedded

namespace {

using Json = nlohmann::ordered_json;

/// The false-colour scale as colours at even steps, for the legend: "rgb(0,0,4)", ...
Json scale_colors() {
  constexpr int steps = 33;
  Image ramp(steps, 1, 1);
  for (int x = 0; x < steps; ++x) ramp.at(x, 0)[0] = static_cast<float>(x) / (steps - 1);
  const Image colors = false_color(ramp, 1.0F);
  Json list = Json::array();
  for (int x = 0; x < steps; ++x) {
    const std::span<const float> rgb = colors.at(x, 0);
    const auto byte = [&rgb](std::size_t channel) { return std::lround(rgb[channel] * 255.0F); };
    list.push_back(fmt::format("rgb({},{},{})", byte(0), byte(1), byte(2)));
  }
  return list;
}

/// A record's figures as the page prints them, the same as in the table.
Json display(const Record& record) {
  const auto figure = [&record](auto member) -> std::string {
    return record.error ? error_text((*record.error).*member) : "n/a";
  };
  const bool floor_known = record.error && record.error->noise_floor;
  const TimeRatio& ratio = record.ratio_to_direct;
  const std::optional<FrameBuildTime>& build = record.frame_build;
  return {{"error", figure(&RecordError::normalized_color)},
          {"at_floor", at_noise_floor(record)},
          {"noise_floor", floor_known ? error_text(*record.error->noise_floor) : "n/a"},
          {"representation", figure(&RecordError::representation)},
          {"filtering", figure(&RecordError::filtering)},
          {"equivalent", equivalent_text(record)},
          {"frame", spread_text(record.frame_ms.median, record.frame_ms.minimum, record.frame_ms.p90)},
          {"ratio", spread_text(ratio.median, ratio.minimum, ratio.maximum)},
          {"fps", three_figures(record.fps)},
          {"build", build ? fmt::format("{}, {}", three_figures(build->ms), timing_name(build->timing)) : "none"},
          {"precompute", three_figures(record.precompute_seconds)},
          {"bytes", readable_bytes(record.precompute_bytes)},
          {"bytes_per_texel", bytes_per_texel_text(record)},
          {"left_out", list_text(record.effects_left_out, "none")},
          {"reading", reading(record)}};
}

std::string page_data(const Results& results) {
  Json head = Json::array();
  for (const Provenance& line : provenance(results)) head.push_back({{"label", line.label}, {"value", line.value}});
  Json records = Json::array();
  for (const Record& record : results.records) records.push_back(display(record));
  const Json data{{"results", results_document(results)},
                  {"provenance", std::move(head)},
                  {"display", std::move(records)},
                  {"scale_top", error_text(results.error_scale)},
                  {"scale_colors", scale_colors()}};
  return script_escaped(json_text(data, -1));
}

}  // namespace

std::string results_page(const Results& results) {
  const std::string data = page_data(results);
  const std::string title = html_escaped(results.scene.name);
  const std::string table = html_escaped(results_table(results));
  const std::string experiment = results.experiment ? experiment_html(*results.experiment) : std::string();
  const auto text = [](std::string_view file) { return find_text(embedded::page_texts, file)->text; };
  return fill_template(text("page.html"), {{"title", title},
                                           {"css", text("page.css")},
                                           {"chart", text("chart.min.js")},
                                           {"script", text("page.js")},
                                           {"table", table},
                                           {"experiment", experiment},
                                           {"data", data}});
}

}  // namespace footprint
