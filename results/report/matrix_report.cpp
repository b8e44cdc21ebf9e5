// Members side by side, as JSON, as lines and as a table.
#include "results/report/matrix_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "renderer/core/files.hpp"
#include "results/report/csv_field.hpp"
#include "results/report/experiment_report.hpp"
#include "results/report/figures.hpp"
#include "results/report/markup.hpp"
#include "results/report/record_fields.hpp"
#include "results/report/report.hpp"

namespace footprint {
namespace {

// With paths from the matrix' folder.
Record seen_from_above(Record record, const std::string& folder) {
  RecordImages& images = record.images;
  for (std::string* path : {&images.color, &images.reference, &images.error, &images.error_shared, &images.flip,
                            &images.interior, &images.standard_error}) {
    if (!path->empty()) path->insert(0, folder + "/");
  }
  return record;
}

std::vector<std::string> table_row(const MatrixMember& member, const Record& record) {
  std::vector<std::string> row;
  for (const auto& [axis, value] : member.results.coordinates) row.push_back(value);
  row.insert(row.end(), {record.method, fmt::format("{}", record.distance),
                         record.error ? error_text(record.error->normalized_color) : "n/a",
                         record.error ? error_text(record.error->causes.shading) : "n/a",
                         record.error ? error_text(record.error->noise_floor) : "n/a",
                         three_figures(record.frame_ms.median), three_figures(record.ratio_to_direct.median)});
  return row;
}

std::string records_table(const MatrixResults& matrix) {
  std::vector<MarkdownColumn> columns;
  for (const auto& [axis, value] : matrix.members.front().results.coordinates) columns.push_back({axis, false});
  columns.push_back({"Method", false});
  for (const char* title : {"Distance", "Error", "Shading", "Floor", "Frame ms", "x direct"})
    columns.push_back({title});
  std::vector<std::vector<std::string>> rows;
  for (const MatrixMember& member : matrix.members) {
    for (const Record& record : member.results.records) rows.push_back(table_row(member, record));
  }
  return markdown_table(columns, rows);
}

// The lines of the members' results.csv, each after its member's name, footprint filter and seed.
std::string matrix_csv(const MatrixResults& matrix) {
  std::string csv = fmt::format("member,footprint,seed,{}{}", csv_header(), csv_line_end);
  for (const auto& [folder, results] : matrix.members) {
    for (const Record& record : results.records)
      csv += fmt::format("{},{},{},{}{}", csv_field(folder), csv_field(results.footprint), results.reference.seed,
                         csv_line(seen_from_above(record, folder)), csv_line_end);
  }
  return csv;
}

}  // namespace

std::string matrix_table(const MatrixResults& matrix) {
  std::string text = fmt::format("# {}\n", markdown_escaped(matrix.report.title)) + experiment_markdown(matrix.report);
  if (!matrix.left_out.empty())
    text += fmt::format("\nNot judged, because members were left out: {}.\n",
                        markdown_escaped(fmt::format("{}", fmt::join(matrix.left_out, "; "))));
  return text + fmt::format("\n## All records, of {} members\n\n", matrix.members.size()) + records_table(matrix) +
         "\nEach member's own report is in the folder of its name. Floor: the part of the error that the reference's "
         "noise causes.\n";
}

void write_matrix_report(const MatrixResults& matrix, const std::filesystem::path& folder) {
  write_file_atomically(folder / "matrix.json", json_text(to_json_value(matrix), 2) + "\n");
  write_file_atomically(folder / "results.csv", matrix_csv(matrix));
  write_file_atomically(folder / "table.md", matrix_table(matrix));
  write_file_atomically(folder / "index.html", matrix_page(matrix));
}

}  // namespace footprint
