// Writes the stages of each edit, and their median, least and most over the frames.
#include "results/report/edit_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "renderer/core/files.hpp"
#include "renderer/core/memory.hpp"
#include "results/report/columns.hpp"
#include "results/report/figures.hpp"
#include "results/report/page.hpp"
#include "results/report/record_fields.hpp"
#include "results/report/report.hpp"

namespace footprint {
namespace {

constexpr const char* edit_schema = "footprint-edit/1";
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

std::vector<double> edit_times(const EditRun& run) {
  std::vector<double> times;
  for (const EditRecord& record : run.records) times.push_back(milliseconds * record.seconds());
  return times;
}

}  // namespace

double EditRecord::seconds() const {
  return std::accumulate(stages.begin(), stages.end(), 0.0,
                         [](double sum, const StageTime& time) { return sum + time.seconds; });
}

std::vector<std::string> stage_names(const EditRun& run) {
  std::vector<std::string> names;
  for (const EditRecord& record : run.records) {
    for (const StageTime& time : record.stages) {
      if (std::ranges::find(names, time.stage) == names.end()) names.push_back(time.stage);
    }
  }
  return names;
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

void fields(JsonWriter& archive, const EditRun& value) {
  archive("schema", edit_schema);
  archive("tool", value.tool);
  archive("backend", value.backend);
  archive("scene", value.scene);
  archive("kind", value.kind);
  archive("method", value.method);
  archive("size", std::tie(value.width, value.height));
  archive("records", value.records);
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
  std::vector<std::vector<std::string>> rows;
  for (const std::string& stage : stage_names(run)) {
    std::vector<double> values;
    for (const EditRecord& record : run.records) {
      if (const auto value = stage_ms(record, stage)) values.push_back(*value);
    }
    rows.push_back(table_row(stage, std::move(values)));
  }
  std::vector<double> times = edit_times(run);
  rows.push_back(table_row("edit", times));
  std::ranges::sort(times);
  return text + markdown_table({{"Stage", false}, {"Median ms"}, {"Minimum"}, {"Maximum"}}, rows) +
         fmt::format(R"(
{} edits per second (median); {} of baked maps. An edit is all stages, from new parameters to an image of
{}x{} pixels. geometry: triangles and normal map of the patch. other: remaining bake time. upload: the baked maps to
OpenGL. frame: one image rendered.
)",
                     three_figures(milliseconds / median(times)), readable_bytes(run.records.back().bytes), run.width,
                     run.height);
}

void write_edit(const EditRun& run, const std::filesystem::path& folder) {
  write_file_atomically(folder / "edit.json", edit_json(run));
  write_file_atomically(folder / "edit.csv", edit_csv(run));
  write_file_atomically(folder / "table.md", edit_table(run));
}

}  // namespace footprint
