// Writes the figures of the NDF inspector, one object per method.
#include "results/report/ndf_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "results/report/page.hpp"
#include "results/report/record_fields.hpp"
#include "results/report/report.hpp"

namespace footprint {
namespace {

std::string figure(double value) { return std::isfinite(value) ? fmt::format("{:.4g}", value) : "not finite"; }

Table table_of(const NdfResults& results) {
  Table table{.heading = {}, .columns = {{"method", false}, {"L2"}, {"energy"}, {"peak"}, {"lobes"}}, .rows = {}};
  table.rows.push_back({"truth", "0", "1", figure(results.exact.peak), fmt::format("{}", results.facets)});
  for (const NdfRecord& r : results.records)
    table.rows.push_back({r.method, figure(r.l2), figure(r.energy), figure(r.peak), fmt::format("{}", r.lobes)});
  return table;
}

std::string conditions(const NdfResults& results) {
  const auto& f = results.footprint;
  return fmt::format("lobe {}{}, footprint {:.6g},{:.6g},{:.6g},{:.6g}: {:.6g} texels, level {:.4g}",
                     results.lobe_varies ? "varies, the narrowest " : "", results.lobe, f[0], f[1], f[2], f[3],
                     results.texels, results.level);
}

// Errors that rounding explains are equal. The results have a record.
std::string closest_methods(const NdfResults& results) {
  constexpr double rounding = 1e-5;
  const double least = std::ranges::min_element(results.records, {}, &NdfRecord::l2)->l2;
  std::vector<std::string> names;
  for (const NdfRecord& record : results.records) {
    if (record.l2 <= std::max(least, rounding)) names.push_back(record.method);
  }
  return fmt::format("{} {} closest to the exact NDF: relative L2 error {}.", fmt::join(names, ", "),
                     names.size() == 1 ? "is" : "are", least < rounding ? "below 1e-05" : figure(least));
}

PageImage image_of(const std::string& name, const NdfImages& images, const std::string& caption) {
  return {.name = name,
          .png = images.picture,
          .values = images.density.substr(0, images.density.rfind('.')) + "_values.js",
          .error = images.difference,
          .caption = caption};
}

}  // namespace

std::string ndf_json(const NdfResults& results) { return json_text(to_json_value(results), 2) + "\n"; }

std::string ndf_table(const NdfResults& results) {
  const Table table = table_of(results);
  return fmt::format("{}\n\n{}", conditions(results), markdown_table(table.columns, table.rows));
}

std::string ndf_page(const NdfResults& results) {
  PageView view{.label = "footprint", .images = {image_of("truth", results.exact.images, "")}};
  for (const NdfRecord& record : results.records)
    view.images.push_back(image_of(record.method, record.images, "L2 " + figure(record.l2)));
  Page page{.title = "NDF of " + results.source,
            .eyebrow = "normal distributions of one footprint",
            .lede = conditions(results) + ".",
            .text = ndf_table(results),
            .views = {std::move(view)},
            .in_false_color = true,
            .sections = {{.heading = "Figures", .table = table_of(results)}},
            .provenance = {{"Source", results.source},
                           {"Material", results.material},
                           {"Footprint filter", results.filter},
                           {"Facets", std::to_string(results.facets)},
                           {"Directions", std::to_string(results.directions)},
                           {"Scale", fmt::format("0 to {} per steradian", figure(results.scale))},
                           {"Version", "footprint " + results.version}}};
  if (!results.records.empty()) {
    page.answer = {closest_methods(results)};
    page.shown = {std::ranges::min_element(results.records, {}, &NdfRecord::l2)->method};
  }
  for (const std::string& note : results.notes) page.provenance.push_back({"Warning", note});
  return page_html(page);
}

}  // namespace footprint
