// The reports of a run of the hard cases: the page docs/results/stability.md, and every row as JSON.
#pragma once

#include <string>
#include <vector>

#include "tests/hard_cases/hard_run.hpp"

namespace footprint::hard_cases {

/// Markdown: a table of methods and groups of cases, the figures that did not pass, and the list of cases.
[[nodiscard]] std::string stability_page(const std::vector<HardRow>& rows);

/// JSON of the schema `footprint-hard-cases/2`, one object per row.
[[nodiscard]] std::string hard_cases_json(const std::vector<HardRow>& rows);

/// One line for each failed row.
[[nodiscard]] std::vector<std::string> failures_of(const std::vector<HardRow>& rows);

}  // namespace footprint::hard_cases
