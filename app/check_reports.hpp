// What `footprint check` holds its runs to, and how it tells other programs: JUnit XML, annotations, a baseline.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "results/report/check_outcomes.hpp"

namespace footprint {

/// What is asked for beside the exit code.
struct CheckReports {
  std::string junit;     ///< file to write; empty: none
  bool github = false;   ///< workflow commands on standard output
  std::string baseline;  ///< file to hold against; empty: none
  bool update = false;   ///< write it anew instead
};

/// Collects the outcomes of runs and reports them.
class CheckBook {
 public:
  /// Reads the baseline that runs are to be held against. Errors (usage): it is missing or none; it is to be updated
  /// and not named.
  explicit CheckBook(CheckReports reports);

  /// The outcomes of one run, or of a matrix.
  void add(const Results& results);
  void add(const ExperimentReport& report);

  /// Writes and prints what is asked for; a baseline that is updated is written here, and how it differs is printed.
  /// Errors (machine): a file cannot be written.
  void report() const;

  /// What fell short, a line each, with its experiment where there are several.
  [[nodiscard]] std::vector<std::string> shortfalls() const;

 private:
  void update_baseline() const;

  CheckReports reports_;
  std::optional<Baseline> baseline_;
  BaselineFigures figures_;
  std::vector<CheckOutcome> outcomes_;
  std::size_t runs_ = 0;
};

}  // namespace footprint
