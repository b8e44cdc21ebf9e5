// Outcomes from results, and the files made of them.
#include "app/check_reports.hpp"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

#include "app/standard_output.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/files.hpp"

namespace footprint {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// None where there is no such file and it is about to be made.
std::optional<Baseline> baseline_of(const CheckReports& reports) {
  if (reports.baseline.empty()) {
    if (!reports.update) return {};
    throw Error(ErrorKind::usage, "--update-baseline", "the baseline is not given", "add --baseline FILE");
  }
  std::error_code unknown;
  if (fs::is_regular_file(reports.baseline, unknown))
    return parse_baseline(text_of(reports.baseline), reports.baseline);
  if (reports.update) return {};
  throw Error(ErrorKind::usage, reports.baseline, "no such baseline", "--update-baseline writes it");
}

}  // namespace

CheckBook::CheckBook(CheckReports reports) : reports_(std::move(reports)), baseline_(baseline_of(reports_)) {}

void CheckBook::add(const ExperimentReport& report) {
  ++runs_;
  for (CheckOutcome& outcome : check_outcomes(report)) outcomes_.push_back(std::move(outcome));
}

void CheckBook::add(const Results& results) {
  add(results.experiment.value());
  const BaselineFigures figures = baseline_figures(results);
  if (baseline_ && !reports_.update) {
    for (CheckOutcome& outcome : compare_with_baseline(*baseline_, figures, reports_.baseline))
      outcomes_.push_back(std::move(outcome));
  }
  figures_.insert(figures.begin(), figures.end());
}

void CheckBook::report() const {
  if (!reports_.junit.empty()) write_file_atomically(reports_.junit, junit_xml(outcomes_));
  if (reports_.update) update_baseline();
  if (reports_.github) write_output(github_annotations(outcomes_));
}

// Experiments that were not run stay as they are.
void CheckBook::update_baseline() const {
  Baseline next = baseline_.value_or(Baseline{});
  std::string text;
  for (const CheckOutcome& outcome : compare_with_baseline(next, figures_, reports_.baseline)) {
    if (!outcome.failure.empty())
      text += fmt::format("{}: {}: {}: {}\n", reports_.baseline, outcome.suite, outcome.name, outcome.failure);
  }
  for (const auto& [experiment, records] : figures_) next.figures[experiment] = records;
  write_file_atomically(reports_.baseline, baseline_json(next));
  write_output(text.empty() ? fmt::format("{}: no differences\n", reports_.baseline) : text);
}

std::vector<std::string> CheckBook::shortfalls() const {
  std::vector<std::string> lines;
  for (const CheckOutcome& outcome : outcomes_) {
    if (outcome.failure.empty()) continue;
    lines.push_back(fmt::format("{}{}: {}", runs_ > 1 ? outcome.suite + ": " : "", outcome.name, outcome.failure));
  }
  return lines;
}

}  // namespace footprint
