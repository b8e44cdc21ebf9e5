// Results as files that people and programs read (results.json, results.csv, table.md, index.html), and as printed
// text; the files that an earlier results.json lists.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "renderer/core/run_folder.hpp"
#include "results/report/records.hpp"

namespace footprint {

/// The document of docs/results.schema.json, "schema": "footprint-results/2"; pretty-printed, key order fixed,
/// infinities and absent figures as null.
[[nodiscard]] std::string results_json(const Results& results);

/// One line per record, RFC 4180; the header names every column (figure_table.hpp).
[[nodiscard]] std::string results_csv(const Results& results);

/// The page, whole and self-contained but for the pictures in `images/` beside it; opens from disk without a network.
[[nodiscard]] std::string results_page(const Results& results);

/// Writes the four files into `folder` (which exists), each whole or not at all: results.json first, then the others,
/// whose loss is a loss of the folder. The losses so far are warnings in each file. Errors (machine): no results.json.
void write_report(const Results& results, const RunFolder& folder);

/// The value of `"schema"` in every results.json that this version writes.
inline constexpr const char* results_schema = "footprint-results/2";

/// JSON text; bytes that are not UTF-8 become U+FFFD.
/// indent: spaces per level, or -1 for one line.
[[nodiscard]] std::string json_text(const nlohmann::ordered_json& document, int indent);

/// The pictures that a results.json of this program lists, relative to its folder; none where the file is not there, is
/// another program's, or cannot be read.
[[nodiscard]] std::vector<std::filesystem::path> listed_files(const std::filesystem::path& results_json);

/// A reference that an earlier comparison wrote.
struct ListedReference {
  float exposure = 1.0F;                 ///< of that comparison
  std::filesystem::path standard_error;  ///< EXR
};

/// The entry of the reference FOLDER/images/NAME.exr in the results.json of FOLDER; none if that document is missing,
/// or it does not list that image as a reference.
[[nodiscard]] std::optional<ListedReference> listed_reference(const std::filesystem::path& reference);

/// The files below a subfolder of an output folder, as paths from the output folder, sorted.
[[nodiscard]] std::vector<std::string> files_below(const std::filesystem::path& folder, const std::string& subfolder);

/// One member.
struct MatrixMember {
  std::string folder;  ///< of its own report, next to that of the matrix
  Results results;     ///< with its coordinates
};

/// A whole matrix, or the part of it that was run.
struct MatrixResults {
  ExperimentReport report;                 ///< claims, thresholds and published figures over all members
  std::vector<std::string> left_out;       ///< of those, the ones over members that were not run: they are not judged
  std::vector<MatrixMember> members = {};  ///< one or more
};

/// Its claims and thresholds, and every record in one table, in Markdown.
[[nodiscard]] std::string matrix_table(const MatrixResults& matrix);

/// The page over all members, which shows their pictures in their folders; else as results_page (report.hpp).
[[nodiscard]] std::string matrix_page(const MatrixResults& matrix, const std::string& lede = {});

/// Writes the files into `folder` (which exists), each whole or not at all. Errors (machine): cannot write.
void write_matrix_report(const MatrixResults& matrix, const RunFolder& folder);

}  // namespace footprint
