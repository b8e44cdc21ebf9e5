// What an experiment is held to, one outcome each, for the programs that read checks: JUnit XML and the annotations of
// GitHub's workflows.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "results/report/experiment_report.hpp"

namespace footprint {

/// A claim, a threshold or a figure of a baseline.
struct CheckOutcome {
  std::string suite;    ///< the experiment
  std::string name;     ///< "claim NAME", "threshold EXPRESSION"
  std::string failure;  ///< how it fell short; empty: as it should be
  std::string place{};  ///< FILE:LINE or FILE where it is written; empty: nowhere
};

/// Claims, then thresholds.
[[nodiscard]] std::vector<CheckOutcome> check_outcomes(const ExperimentReport& report);

/// "NAME: FAILURE" of what fell short.
[[nodiscard]] std::vector<std::string> shortfalls_of(std::span<const CheckOutcome> outcomes);

/// A JUnit XML document with a test suite an experiment and a test case an outcome; outcomes of one suite stand
/// together.
[[nodiscard]] std::string junit_xml(std::span<const CheckOutcome> outcomes);

/// A workflow command `::error ...::` a line for what fell short.
[[nodiscard]] std::string github_annotations(std::span<const CheckOutcome> outcomes);

}  // namespace footprint
