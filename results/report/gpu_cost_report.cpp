// Writes estimated costs as JSON, CSV and Markdown.
#include "results/report/gpu_cost_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "renderer/core/files.hpp"
#include "results/report/columns.hpp"
#include "results/report/figures.hpp"
#include "results/report/page.hpp"
#include "results/report/ranking.hpp"
#include "results/report/record_fields.hpp"
#include "results/report/report.hpp"

namespace footprint {
namespace {

constexpr const char* cost_schema = "footprint-cost/1";

// The figures of a CSV line, by their names in the JSON.
constexpr std::array<const char*, 17> csv_columns{
    "cost_ns",      "bound",         "arithmetic_ns", "texture_ns",        "bandwidth_ns", "passes_ns",    "alu_clocks",
    "issue_clocks", "texture_reads", "bytes_fetched", "bytes_from_memory", "loop_rounds",  "instructions", "registers",
    "waves",        "shader_bytes",  "failure"};

std::string csv_value(const JsonWriter::Json& value) {
  if (value.is_null()) return {};
  return csv_field(value.is_string() ? value.get<std::string>() : value.dump());
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
    Table& table = tables.emplace_back(Table{.heading = first.gpu + where,
                                             .columns = {{"Method", false},
                                                         {"ns per pixel"},
                                                         {first.ratio_to_direct ? "Over direct" : "Over the first"},
                                                         {"Bound", false},
                                                         {"Passes ns"},
                                                         {"ALU clocks"},
                                                         {"Texture reads"},
                                                         {"Bytes fetched"},
                                                         {"Registers"},
                                                         {"Waves"}},
                                             .rows = {}});
    for (const MethodCosts& method : methods)
      table.rows.push_back(table_row(method, method.gpus.at(gpu), first.cost_ns));
  }
  return tables;
}

// The tables of the distances of a run.
std::vector<Table> gpu_tables(const Results& results) {
  std::vector<Table> tables;
  for (const double distance : distances_of(results)) {
    std::vector<MethodCosts> methods;
    for (const Record& record : records_at(results, distance)) {
      if (!record.gpu_costs.empty())
        methods.push_back({.method = record.method, .trips = {}, .gpus = record.gpu_costs});
    }
    std::ranges::move(gpu_tables(methods, fmt::format(", distance {:g}", distance)), std::back_inserter(tables));
  }
  return tables;
}

std::string markdown_of(const std::vector<Table>& tables) {
  std::string text;
  for (const Table& table : tables)
    text += fmt::format("### {}\n\n{}\n", table.heading, markdown_table(table.columns, table.rows));
  return text;
}

constexpr const char* gpu_note =
    "An estimate from the driver's compiler and published rates, not a measurement (docs/explanation/gpu-cost.md): the "
    "largest of "
    "arithmetic, texture and memory time, plus the passes before it. 1 ns per pixel is 2.07 ms for 1920x1080 pixels.";

}  // namespace

void fields(JsonWriter& archive, const CostReport& value) {
  archive("schema", cost_schema);
  archive("tool", value.tool);
  archive("backend", value.backend);
  archive("scene", value.scene);
  archive("footprint", value.footprint);
  archive("compiler", value.compiler);
  archive("size", std::tie(value.width, value.height));
  archive("distance", value.distance);
  archive("methods", value.methods);
}

std::string cost_json(const CostReport& report) { return json_text(to_json_value(report), 2) + "\n"; }

std::string cost_csv(const CostReport& report) {
  std::string csv = "method,gpu,lookups,map_bytes,pixels,probes,lobes,rounds";
  for (const char* column : csv_columns) csv += fmt::format(",{}", column);
  csv += "\r\n";
  for (const MethodCosts& method : report.methods) {
    for (const GpuCost& cost : method.gpus) {
      csv += fmt::format("{},{},{},{},{},{},{},{}", csv_field(method.method), csv_field(cost.gpu), method.lookups,
                         method.map_bytes, method.pixels, method.trips.probes, method.trips.lobes, method.trips.rounds);
      const auto json = to_json_value(cost);
      for (const char* column : csv_columns) csv += "," + csv_value(json.at(column));
      csv += "\r\n";
    }
  }
  return csv;
}

std::string cost_table(const CostReport& report) {
  std::string text =
      fmt::format("# Estimated cost on GPUs: {}, {}x{}, distance {:g}, {}\n\n", markdown_escaped(report.scene.name),
                  report.width, report.height, report.distance, report.footprint);
  return text + markdown_of(gpu_tables(report.methods, "")) + gpu_note + "\n";
}

std::string gpu_costs_markdown(const Results& results) {
  const std::vector<Table> tables = gpu_tables(results);
  if (tables.empty()) return {};
  return fmt::format("\n## Estimated cost on GPUs\n\n{}{}\n", markdown_of(tables), gpu_note);
}

std::string gpu_costs_html(const Results& results) {
  const std::vector<Table> tables = gpu_tables(results);
  if (tables.empty()) return {};
  std::string html = "<details class=\"fold\" id=\"gpus\"><summary>Estimated cost on GPUs</summary>\n";
  for (const Table& table : tables) html += html_table(table);
  return html + fmt::format("<p class=\"note\">{}</p></details>\n", html_escaped(gpu_note));
}

void write_cost(const CostReport& report, const std::filesystem::path& folder) {
  write_file_atomically(folder / "cost.json", cost_json(report));
  write_file_atomically(folder / "cost.csv", cost_csv(report));
  write_file_atomically(folder / "table.md", cost_table(report));
}

}  // namespace footprint
