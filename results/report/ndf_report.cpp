// Writes the figures of the NDF inspector, one object a method.
#include "results/report/ndf_report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "results/report/markdown_table.hpp"

namespace footprint {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json images_json(const NdfImages& images) {
  Json json{{"density", images.density}, {"picture", images.picture}};
  if (!images.difference.empty()) json["difference"] = images.difference;
  return json;
}

Json record_json(const NdfRecord& record) {
  Json options = Json::object();
  for (const auto& [name, value] : record.options) {
    options[name] = std::visit([](const auto& held) { return Json(held); }, value);
  }
  return {{"l2", number(record.l2)}, {"energy", number(record.energy)}, {"peak", number(record.peak)},
          {"lobes", record.lobes},   {"options", std::move(options)},   {"images", images_json(record.images)}};
}

Json methods_json(const NdfResults& results) {
  Json methods = Json::object();
  for (const NdfRecord& record : results.records) methods[record.method] = record_json(record);
  return methods;
}

std::string figure(double value) { return std::isfinite(value) ? fmt::format("{:.4g}", value) : "not finite"; }

}  // namespace

std::string ndf_json(const NdfResults& r) {
  const Json json{
      {"schema", ndf_schema},
      {"tool", {{"name", "footprint"}, {"version", r.version}}},
      {"source",
       {{"path", r.source},
        {"kind", r.kind},
        {"material", r.material},
        {"width", r.map_size[0]},
        {"height", r.map_size[1]}}},
      {"lobe", {{"narrowest", r.lobe}, {"varies", r.lobe_varies}}},
      {"footprint", {{"u0", r.footprint[0]}, {"v0", r.footprint[1]}, {"u1", r.footprint[2]}, {"v1", r.footprint[3]}}},
      {"texels", {{"area", number(r.texels)}, {"valid_share", number(r.valid_share)}, {"distinct", r.facets}}},
      {"fetch", {{"level", number(r.level)}, {"filter", r.filter}}},
      {"grid", {{"resolution", r.resolution}, {"directions", r.directions}, {"fine_enough", r.fine_enough}}},
      {"pictures", {{"scale", number(r.scale)}, {"strip", r.strip}}},
      {"truth",
       {{"energy", number(r.truth.energy)},
        {"expected_energy", number(r.truth.expected_energy)},
        {"peak", number(r.truth.peak)},
        {"images", images_json(r.truth.images)}}},
      {"methods", methods_json(r)},
      {"notes", r.notes}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string ndf_table(const NdfResults& results) {
  std::vector<std::vector<std::string>> rows;
  rows.push_back({"truth", "0", "1", figure(results.truth.peak), fmt::format("{}", results.facets)});
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
