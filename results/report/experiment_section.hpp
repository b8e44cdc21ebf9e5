// What became of an experiment, for readers: measured beside published, claims, thresholds.
#pragma once

#include <string>

#include "results/report/experiment_report.hpp"

namespace footprint {

/// How a claim or a threshold fell short, in one line without its name.
[[nodiscard]] std::string shortfall_of(const ClaimOutcome& claim);
[[nodiscard]] std::string shortfall_of(const ThresholdOutcome& threshold);

/// The sections of table.md that an experiment adds, each with its heading.
[[nodiscard]] std::string experiment_markdown(const ExperimentReport& report);

/// The same for index.html: a <section> with the composed figures, every text escaped.
[[nodiscard]] std::string experiment_html(const ExperimentReport& report);

}  // namespace footprint
