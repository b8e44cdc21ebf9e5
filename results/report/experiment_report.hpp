// The outcome of an experiment for readers, and for other programs: JUnit XML, annotations of GitHub's workflows, and
// the baselines that later runs are compared with.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "results/report/records.hpp"

namespace footprint {

/// The fault of a claim or a threshold, in one line without its name.
[[nodiscard]] std::string shortfall_of(const ClaimOutcome& claim);
[[nodiscard]] std::string shortfall_of(const ThresholdOutcome& threshold);

/// The sections of table.md that an experiment adds, each with its heading.
[[nodiscard]] std::string experiment_markdown(const ExperimentReport& report);

/// The <section> of index.html that an experiment adds, with the composed figures, every text escaped.
[[nodiscard]] std::string experiment_html(const ExperimentReport& report);

/// A claim, a threshold or a figure of a baseline.
struct CheckOutcome {
  std::string suite;        ///< the experiment
  std::string name;         ///< "claim NAME", "threshold EXPRESSION"
  std::string failure;      ///< how it fell short; empty: as it should be
  std::string undecided{};  ///< why nothing here decides a claim, which is no failure; empty: it was decided
  std::string place{};      ///< FILE:LINE or FILE where it is written; empty: nowhere
};

/// Claims, then thresholds.
[[nodiscard]] std::vector<CheckOutcome> check_outcomes(const ExperimentReport& report);

/// "NAME: FAILURE" of those that failed.
[[nodiscard]] std::vector<std::string> shortfalls_of(std::span<const CheckOutcome> outcomes);

/// A JUnit XML document with a test suite per experiment and a test case per outcome; outcomes of one suite are
/// adjacent. A claim that nothing here decides is a skipped test with its reason.
[[nodiscard]] std::string junit_xml(std::span<const CheckOutcome> outcomes);

/// One workflow command `::error ...::` per outcome that failed.
[[nodiscard]] std::string github_annotations(std::span<const CheckOutcome> outcomes);

/// Figures by their names ("error", "shading", "flicker", "bytes"), by record ("toksvig at 2"), by experiment.
using BaselineFigures = std::map<std::string, std::map<std::string, std::map<std::string, double>>>;

/// A baseline: figures, and by how much errors and flicker may differ from them.
struct Baseline {
  double tolerance =
      1e-4;  ///< normalised colour error; pictures are the same to about 1e-5 between kinds of processors
  BaselineFigures figures;
};

/// The figures of an experiment's records: errors, flicker and the bytes of the bakes. No times.
[[nodiscard]] BaselineFigures baseline_figures(const Results& results);

/// The document of format `footprint-baseline/1`.
[[nodiscard]] std::string baseline_json(const Baseline& baseline);

/// Reads it. Errors (usage): not such a document; `place` is the file.
[[nodiscard]] Baseline parse_baseline(const std::string& text, const std::string& place);

/// One outcome per record of the experiments in `now`. It fails if a figure differs from the baseline's by more than
/// the tolerance (bytes: at all), or if only one of both has the figure or the record. Other experiments are skipped.
/// file: of the baseline.
[[nodiscard]] std::vector<CheckOutcome> compare_with_baseline(const Baseline& baseline, const BaselineFigures& now,
                                                              const std::string& file);

}  // namespace footprint
