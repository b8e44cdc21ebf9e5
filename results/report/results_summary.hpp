// What a terminal shows of results: the answer first, then one table of the figures that a choice rests on.
#pragma once

#include <string>

#include "results/report/records.hpp"

namespace footprint {

/// Plain text, at most about 110 columns wide while names are short: for each distance which method is the most
/// accurate and which is the cheapest that improves on `direct`; then a row for each method and distance, the least
/// error first.
[[nodiscard]] std::string results_summary(const Results& results);

}  // namespace footprint
