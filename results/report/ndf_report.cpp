// Writes the figures of the NDF inspector, one object per method.
#include "results/report/ndf_report.hpp"

#include <fmt/format.h>

#include <cmath>

#include "results/report/markup.hpp"
#include "results/report/record_fields.hpp"
#include "results/report/report.hpp"

namespace footprint {
namespace {

std::string figure(double value) { return std::isfinite(value) ? fmt::format("{:.4g}", value) : "not finite"; }

}  // namespace

std::string ndf_json(const NdfResults& results) { return json_text(to_json_value(results), 2) + "\n"; }

std::string ndf_table(const NdfResults& results) {
  std::vector<std::vector<std::string>> rows;
  rows.push_back({"truth", "0", "1", figure(results.exact.peak), fmt::format("{}", results.facets)});
  for (const NdfRecord& r : results.records) {
    rows.push_back({r.method, figure(r.l2), figure(r.energy), figure(r.peak), fmt::format("{}", r.lobes)});
  }
  const std::vector<MarkdownColumn> columns{{"method", false}, {"L2"}, {"energy"}, {"peak"}, {"lobes"}};
  const auto& f = results.footprint;
  return fmt::format("lobe {}{}, footprint {:.6g},{:.6g},{:.6g},{:.6g}: {:.6g} texels, level {:.4g}\n\n{}",
                     results.lobe_varies ? "varies, the narrowest " : "", results.lobe, f[0], f[1], f[2], f[3],
                     results.texels, results.level, markdown_table(columns, rows));
}

}  // namespace footprint
