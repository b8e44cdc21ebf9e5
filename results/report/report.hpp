// Results as files that people and programs read (results.json, results.csv, table.md, index.html), and as printed
// text.
#pragma once

#include <filesystem>
#include <string>

#include "results/report/records.hpp"

namespace footprint {

/// The document of docs/results.schema.json, "schema": "footprint-results/2"; pretty-printed, key order fixed,
/// infinities and absent figures as null.
[[nodiscard]] std::string results_json(const Results& results);

/// One line per record, RFC 4180; the header names every column (columns.hpp).
[[nodiscard]] std::string results_csv(const Results& results);

/// The error and fps table in Markdown, aligned so that it also reads well in a terminal.
[[nodiscard]] std::string results_table(const Results& results);

/// The page, whole and self-contained but for the pictures in `images/` beside it; opens from disk without a network.
[[nodiscard]] std::string results_page(const Results& results);

/// The text that the program prints: for each distance the most accurate method and the cheapest that improves on
/// `direct`, then one row per method and distance, the smallest error first. At most about 110 columns wide with short
/// names.
[[nodiscard]] std::string results_summary(const Results& results);

/// Writes the four files into `folder` (which exists), each whole or not at all. Errors (machine): cannot write.
void write_report(const Results& results, const std::filesystem::path& folder);

}  // namespace footprint
