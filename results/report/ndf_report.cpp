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

void fields(JsonWriter& archive, const NdfImages& value) {
  archive("density", value.density);
  archive("picture", value.picture);
  if (!value.difference.empty()) archive("difference", value.difference);
}

void fields(JsonWriter& archive, const NdfRecord& value) {
  archive("l2", value.l2);
  archive("energy", value.energy);
  archive("peak", value.peak);
  archive("lobes", value.lobes);
  archive("options", value.options);
  archive("images", value.images);
}

void fields(JsonWriter& archive, const ExactNdfRecord& value) {
  archive("energy", value.energy);
  archive("expected_energy", value.expected_energy);
  archive("peak", value.peak);
  archive("images", value.images);
}

void fields(JsonWriter& archive, const NdfResults& value) {
  archive("schema", ndf_schema);
  archive("tool", ToolInfo{.name = "footprint", .version = value.version});
  archive.group("source", [&](JsonWriter& source) {
    source("path", value.source);
    source("kind", value.kind);
    source("material", value.material);
    source("width", value.map_size[0]);
    source("height", value.map_size[1]);
  });
  archive.group("lobe", [&](JsonWriter& lobe) {
    lobe("narrowest", value.lobe);
    lobe("varies", value.lobe_varies);
  });
  archive.group("footprint", [&](JsonWriter& footprint) {
    footprint("u0", value.footprint[0]);
    footprint("v0", value.footprint[1]);
    footprint("u1", value.footprint[2]);
    footprint("v1", value.footprint[3]);
  });
  archive.group("texels", [&](JsonWriter& texels) {
    texels("area", value.texels);
    texels("valid_share", value.valid_share);
    texels("distinct", value.facets);
  });
  archive.group("fetch", [&](JsonWriter& fetch) {
    fetch("level", value.level);
    fetch("filter", value.filter);
  });
  archive.group("grid", [&](JsonWriter& grid) {
    grid("resolution", value.resolution);
    grid("directions", value.directions);
    grid("fine_enough", value.fine_enough);
  });
  archive.group("pictures", [&](JsonWriter& pictures) {
    pictures("scale", value.scale);
    pictures("strip", value.strip);
  });
  archive("truth", value.exact);
  archive.group("methods", [&](JsonWriter& methods) {
    for (const NdfRecord& record : value.records) methods(record.method.c_str(), record);
  });
  archive("notes", value.notes);
}

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
