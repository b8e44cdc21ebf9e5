// Writes the stages of each edit and their spread, estimated costs per GPU, and the figures of the NDF inspector.
#include "results/report/command_reports.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "renderer/core/files.hpp"
#include "renderer/core/memory.hpp"
#include "results/report/page.hpp"
#include "results/report/ranking.hpp"
#include "results/report/record_fields.hpp"

namespace footprint {
namespace {

constexpr double milliseconds = 1e3;

std::optional<double> stage_ms(const EditRecord& record, const std::string& stage) {
  const auto found = std::ranges::find(record.stages, stage, &StageTime::stage);
  return found == record.stages.end() ? std::nullopt : std::optional(milliseconds * found->seconds);
}

// sorted: at least one value, in ascending order.
double median(const std::vector<double>& sorted) {
  const std::size_t middle = sorted.size() / 2;
  return sorted.size() % 2 == 1 ? sorted[middle] : 0.5 * (sorted[middle - 1] + sorted[middle]);
}

std::vector<std::string> table_row(const std::string& name, std::vector<double> values) {
  std::ranges::sort(values);
  return {name, three_figures(median(values)), three_figures(values.front()), three_figures(values.back())};
}

// The names of the stages, in the order in which they first come in any record.
std::vector<std::string> stage_names(const EditRun& run) {
  std::vector<std::string> names;
  for (const EditRecord& record : run.records) {
    for (const StageTime& time : record.stages) {
      if (std::ranges::find(names, time.stage) == names.end()) names.push_back(time.stage);
    }
  }
  return names;
}

}  // namespace

double EditRecord::seconds() const {
  return std::accumulate(stages.begin(), stages.end(), 0.0,
                         [](double sum, const StageTime& time) { return sum + time.seconds; });
}

void fields(JsonWriter& archive, const EditRecord& value) {
  archive("frame", value.frame);
  archive("parameters", value.parameters);
  archive.group("stage_ms", [&](JsonWriter& stages) {
    for (const StageTime& time : value.stages) stages(time.stage.c_str(), milliseconds * time.seconds);
  });
  archive("edit_ms", milliseconds * value.seconds());
  archive("bytes", value.bytes);
  archive("notes", value.notes);
  archive("image", value.image);
}

std::string edit_json(const EditRun& run) { return json_text(to_json_value(run), 2) + "\n"; }

std::string edit_csv(const EditRun& run) {
  const std::vector<std::string> stages = stage_names(run);
  std::string csv = "frame";
  if (!run.records.empty()) {
    for (const auto& [name, value] : run.records.front().parameters)
      csv += fmt::format(",{}", csv_field(run.kind + "." + name));
  }
  for (const std::string& stage : stages) csv += fmt::format(",{}", csv_field(stage + "_ms"));
  csv += ",edit_ms,bytes,image\r\n";
  for (const EditRecord& record : run.records) {
    csv += std::to_string(record.frame);
    for (const auto& [name, value] : record.parameters) csv += fmt::format(",{}", csv_field(value));
    for (const std::string& stage : stages) csv += fmt::format(",{}", csv_field(stage_ms(record, stage)));
    csv +=
        fmt::format(",{},{},{}\r\n", csv_field(milliseconds * record.seconds()), record.bytes, csv_field(record.image));
  }
  return csv;
}

std::string edit_table(const EditRun& run) {
  std::string text = fmt::format("# {}, {} edits of its {}, {}\n\n", markdown_escaped(run.scene.name),
                                 run.records.size(), run.kind, markdown_escaped(run.method));
  if (run.records.empty()) return text;
  Table table{.columns = {{"Stage", false}, {"Median ms"}, {"Minimum"}, {"Maximum"}}};
  for (const std::string& stage : stage_names(run)) {
    std::vector<double> values;
    for (const EditRecord& record : run.records) {
      if (const auto value = stage_ms(record, stage)) values.push_back(*value);
    }
    table.rows.push_back(table_row(stage, std::move(values)));
  }
  std::vector<double> times;
  for (const EditRecord& record : run.records) times.push_back(milliseconds * record.seconds());
  table.rows.push_back(table_row("edit", times));
  std::ranges::sort(times);
  return text + markdown_table(table) +
         fmt::format(R"(
{} edits per second (median); {} of baked maps. An edit is all stages, from new parameters to an image of
{}x{} pixels. geometry: triangles and normal map of the patch. other: remaining bake time. upload: the baked maps to
OpenGL. frame: one image rendered.
)",
                     three_figures(milliseconds / median(times)), readable_bytes(run.records.back().bytes), run.size[0],
                     run.size[1]);
}

void write_edit(const EditRun& run, const RunFolder& folder) {
  folder.write_document("edit.json", edit_json(run));
  folder.write_text("edit.csv", [&] { return edit_csv(run); });
  folder.write_text("table.md", [&] { return edit_table(run); });
}

namespace {

// The figures of a CSV line, by their names in the JSON.
constexpr std::array<const char*, 25> csv_columns{
    "method",        "gpu",           "lookups",       "map_bytes",         "pixels",
    "probes",        "lobes",         "rounds",        "cost_ns",           "bound",
    "arithmetic_ns", "texture_ns",    "bandwidth_ns",  "passes_ns",         "alu_clocks",
    "issue_clocks",  "texture_reads", "bytes_fetched", "bytes_from_memory", "loop_rounds",
    "instructions",  "registers",     "waves",         "shader_bytes",      "failure"};

std::string cost_csv(const CostReport& report) {
  std::string csv = fmt::format("{}{}", fmt::join(csv_columns, ","), csv_line_end);
  for (const MethodCosts& method : report.methods) {
    for (const GpuCost& cost : method.gpus) {
      auto json = to_json_value(method);
      json.update(to_json_value(method.trips));
      json.update(to_json_value(cost));
      std::vector<std::string> values;
      for (const char* column : csv_columns) values.push_back(csv_value(json.at(column)));
      csv += fmt::format("{}{}", fmt::join(values, ","), csv_line_end);
    }
  }
  return csv;
}

std::vector<std::string> table_row(const MethodCosts& method, const GpuCost& cost, double first_ns) {
  if (cost.failure) return {method.method, "", "", *cost.failure, "", "", "", "", "", ""};
  return {method.method,
          three_figures(cost.cost_ns),
          cost.ratio_to_direct ? three_figures(*cost.ratio_to_direct) : three_figures(cost.cost_ns / first_ns),
          cost.bound,
          three_figures(cost.passes_ns),
          three_figures(cost.alu_clocks),
          three_figures(cost.texture_reads),
          three_figures(cost.bytes_fetched),
          std::to_string(cost.registers),
          std::to_string(cost.waves)};
}

// One table per GPU, of methods that have the same GPUs.
std::vector<Table> gpu_tables(const std::vector<MethodCosts>& methods, const std::string& where) {
  std::vector<Table> tables;
  if (methods.empty()) return tables;
  for (std::size_t gpu = 0; gpu < methods.front().gpus.size(); ++gpu) {
    const GpuCost& first = methods.front().gpus[gpu];
    Table& table = tables.emplace_back(Table{.heading = first.gpu + where});
    table.columns = {{"Method", false}, {"ns per pixel"}, {first.ratio_to_direct ? "Over direct" : "Over the first"}};
    table.columns.push_back({"Bound", false});
    for (const char* title : {"Passes ns", "ALU clocks", "Texture reads", "Bytes fetched", "Registers", "Waves"})
      table.columns.push_back({title});
    for (const MethodCosts& method : methods)
      table.rows.push_back(table_row(method, method.gpus.at(gpu), first.cost_ns));
  }
  return tables;
}

std::vector<Table> gpu_tables(const Results& results) {
  std::vector<Table> tables;
  for (const double distance : distances_of(results)) {
    std::vector<MethodCosts> methods;
    for (const Record& record : records_at(results, distance)) {
      if (!record.gpu_costs.empty()) methods.push_back({.method = record.method, .gpus = record.gpu_costs});
    }
    std::ranges::move(gpu_tables(methods, fmt::format(", distance {:g}", distance)), std::back_inserter(tables));
  }
  return tables;
}

std::string markdown_of(const std::vector<Table>& tables) {
  std::string text;
  for (const Table& table : tables) text += markdown_section(table, 3);
  return text;
}

constexpr const char* gpu_note =
    "An estimate from the driver's compiler and published rates, not a measurement (docs/explanation/gpu-cost.md): the "
    "largest of "
    "arithmetic, texture and memory time, plus the passes before it. 1 ns per pixel is 2.07 ms for 1920x1080 pixels.";

}  // namespace

std::string cost_table(const CostReport& report) {
  std::string text =
      fmt::format("# Estimated cost on GPUs: {}, {}x{}, distance {:g}, {}\n", markdown_escaped(report.scene.name),
                  report.size[0], report.size[1], report.distance, report.footprint);
  return text + markdown_of(gpu_tables(report.methods, "")) + "\n" + gpu_note + "\n";
}

std::string gpu_costs_markdown(const Results& results) {
  const std::vector<Table> tables = gpu_tables(results);
  if (tables.empty()) return {};
  return fmt::format("\n## Estimated cost on GPUs\n{}\n{}\n", markdown_of(tables), gpu_note);
}

std::string gpu_costs_html(const Results& results) {
  const std::vector<Table> tables = gpu_tables(results);
  if (tables.empty()) return {};
  std::string html = "<details class=\"fold\" id=\"gpus\"><summary>Estimated cost on GPUs</summary>\n";
  for (const Table& table : tables) html += html_table(table);
  return html + fmt::format("<p class=\"note\">{}</p></details>\n", html_escaped(gpu_note));
}

void write_cost(const CostReport& report, const RunFolder& folder) {
  folder.write_document("cost.json", json_text(to_json_value(report), 2) + "\n");
  folder.write_text("cost.csv", [&] { return cost_csv(report); });
  folder.write_text("table.md", [&] { return cost_table(report); });
}

namespace {

std::string figure(double value) { return std::isfinite(value) ? fmt::format("{:.4g}", value) : "not finite"; }

Table table_of(const NdfResults& results) {
  Table table{.columns = {{"method", false}, {"L2"}, {"energy"}, {"peak"}, {"lobes"}}};
  table.rows.push_back({"truth", "0", "1", figure(results.truth.peak), fmt::format("{}", results.texels.distinct)});
  for (const auto& [method, r] : results.methods)
    table.rows.push_back({method, figure(r.l2), figure(r.energy), figure(r.peak), fmt::format("{}", r.lobes)});
  return table;
}

std::string conditions(const NdfResults& results) {
  const auto& [u0, v0, u1, v1] = results.footprint;
  return fmt::format("lobe {}{}, footprint {:.6g},{:.6g},{:.6g},{:.6g}: {:.6g} texels, level {:.4g}",
                     results.lobe.varies ? "varies, the narrowest " : "", results.lobe.narrowest, u0, v0, u1, v1,
                     results.texels.area, results.fetch.level);
}

// results: with a method.
const auto& closest(const NdfResults& results) {
  return *std::ranges::min_element(results.methods, {}, [](const auto& method) { return method.second.l2; });
}

// Errors that rounding explains are equal. The results have a method.
std::string closest_methods(const NdfResults& results) {
  constexpr double rounding = 1e-5;
  const double least = closest(results).second.l2;
  std::vector<std::string> names;
  for (const auto& [method, record] : results.methods) {
    if (record.l2 <= std::max(least, rounding)) names.push_back(method);
  }
  return fmt::format("{} {} closest to the exact NDF: relative L2 error {}.", fmt::join(names, ", "),
                     names.size() == 1 ? "is" : "are", least < rounding ? "below 1e-05" : figure(least));
}

PageImage image_of(const std::string& name, const auto& images) {
  return {.name = name,
          .png = images.picture,
          .values = images.density.substr(0, images.density.rfind('.')) + "_values.js"};
}

}  // namespace

std::string ndf_json(const NdfResults& results) { return json_text(to_json_value(results), 2) + "\n"; }

std::string ndf_table(const NdfResults& results) {
  return fmt::format("{}\n\n{}", conditions(results), markdown_table(table_of(results)));
}

std::string ndf_page(const NdfResults& results) {
  PageView view{.label = "footprint", .images = {image_of("truth", results.truth.images)}};
  for (const auto& [method, record] : results.methods) {
    PageImage& image = view.images.emplace_back(image_of(method, record.images));
    image.error = record.images.difference;
    image.caption = "L2 " + figure(record.l2);
  }
  Page page{.title = "NDF of " + results.source.path,
            .eyebrow = "normal distributions of one footprint",
            .lede = conditions(results) + ".",
            .text = ndf_table(results),
            .views = {std::move(view)},
            .in_false_color = true,
            .sections = {{.heading = "Figures", .table = table_of(results)}},
            .provenance = {{"Source", results.source.path},
                           {"Material", results.source.material},
                           {"Footprint filter", results.fetch.filter},
                           {"Facets", std::to_string(results.texels.distinct)},
                           {"Directions", std::to_string(results.grid.directions)},
                           {"Scale", fmt::format("0 to {} per steradian", figure(results.pictures.scale))},
                           {"Version", "footprint " + results.tool.version}}};
  if (!results.methods.empty()) {
    page.answer = {closest_methods(results)};
    page.shown = {closest(results).first};
  }
  for (const std::string& note : results.notes) page.provenance.push_back({"Warning", note});
  return page_html(page);
}

}  // namespace footprint
