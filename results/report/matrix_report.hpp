// The report over all members of an experiment's [matrix]: matrix.json (docs/matrix.schema.json), results.csv, table.md
// and index.html. Each member has its own results.json and page in the folder of its name.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "results/report/records.hpp"

namespace footprint {

/// One member.
struct MatrixMember {
  std::string folder;  ///< of its own report, next to that of the matrix
  Results results;     ///< with its coordinates
};

/// A whole matrix, or the part of it that was run.
struct MatrixResults {
  ExperimentReport report;            ///< claims, thresholds and published figures over all members
  std::vector<std::string> left_out;  ///< of those, the ones over members that were not run: they are not judged
  std::vector<MatrixMember> members;  ///< one or more
};

/// Its claims and thresholds, and every record in one table, in Markdown.
[[nodiscard]] std::string matrix_table(const MatrixResults& matrix);

/// The page over all members, which shows their pictures in their folders; else as results_page (report.hpp).
[[nodiscard]] std::string matrix_page(const MatrixResults& matrix);

/// Writes the files into `folder` (which exists), each whole or not at all. Errors (machine): cannot write.
void write_matrix_report(const MatrixResults& matrix, const std::filesystem::path& folder);

}  // namespace footprint
