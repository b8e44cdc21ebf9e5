// write_report: the four files of a run.
#include "results/report/report.hpp"

#include "renderer/core/files.hpp"

namespace footprint {

void write_report(const Results& results, const std::filesystem::path& folder) {
  write_file_atomically(folder / "results.json", results_json(results));
  write_file_atomically(folder / "results.csv", results_csv(results));
  write_file_atomically(folder / "table.md", results_table(results));
  write_file_atomically(folder / "index.html", results_page(results));
}

}  // namespace footprint
