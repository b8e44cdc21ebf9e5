// results.json as the document of docs/results.schema.json, and the four files of a run.
#include "results/report/report.hpp"

#include "renderer/core/files.hpp"
#include "results/report/ranking.hpp"
#include "results/report/record_fields.hpp"
#include "results/report/results_document.hpp"

namespace footprint {

template <class Archive>
void fields(Archive& archive, Is<Results> auto& value) {
  archive.derived("schema", results_schema);
  archive("tool", value.tool);
  archive("backend", value.backend);
  archive("scene", value.scene);
  archive("reference", value.reference);
  archive("footprint", value.footprint);
  archive("timing", value.timing);
  archive("way", value.way);
  archive("film", value.film);
  archive.derived("experiment", value.experiment);  // judged again from the figures
  if constexpr (!Archive::reads) archive.derived("ranking_warnings", ranking_warnings(value));
  archive("error_scale", value.error_scale);
  archive("error_scales", value.error_scales);
  archive("supersampling", value.supersampling);
  archive("records", value.records);
  archive("pairs", value.pairs);
  archive("ndf", value.ndf);
  archive("quantities", value.quantities);
  archive("files", value.files);
}

nlohmann::ordered_json json_number(const std::optional<double>& value) { return to_json_value(value); }

nlohmann::ordered_json results_document(const Results& results) { return to_json_value(results); }

std::string json_text(const nlohmann::ordered_json& document, int indent) {
  return document.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::string results_json(const Results& results) { return json_text(results_document(results), 2) + "\n"; }

void write_report(const Results& results, const std::filesystem::path& folder) {
  write_file_atomically(folder / "results.json", results_json(results));
  write_file_atomically(folder / "results.csv", results_csv(results));
  write_file_atomically(folder / "table.md", results_table(results));
  write_file_atomically(folder / "index.html", results_page(results));
}

}  // namespace footprint
