// What a run through the hard cases leaves: the page of docs/stability.md, and every row as JSON.
#pragma once

#include <string>
#include <vector>

#include "stability/hard_run.hpp"

namespace footprint::stability {

/// Markdown: a table of methods and groups of cases, what did not hold with its figures, and the cases.
[[nodiscard]] std::string stability_page(const std::vector<HardRow>& rows);

/// `footprint-hard-cases/2`: one object a row.
[[nodiscard]] std::string hard_cases_json(const std::vector<HardRow>& rows);

/// One line for each row that fell.
[[nodiscard]] std::vector<std::string> what_fell(const std::vector<HardRow>& rows);

}  // namespace footprint::stability
