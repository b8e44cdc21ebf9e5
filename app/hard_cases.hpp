// `footprint check hard_cases`: every method in numerically hard cases.
#pragma once

#include <string>
#include <string_view>

#include "experiments/settings/run_settings.hpp"

namespace footprint {

/// The word on the command line instead of an experiment's name.
inline constexpr std::string_view hard_cases_name = "hard_cases";

struct HardCasesRequest {
  RunSettings run;     ///< only its backend and methods count
  bool wide = false;   ///< also every storage in every case, and slow cases
  std::string output;  ///< folder; overwritten as a whole
  bool quiet = false;  ///< no progress on standard error
};

/// Writes stability.md, hard_cases.json and images of the failures into the output folder. tests/hard_cases/ defines
/// it; a program built with FOOTPRINT_TESTS=OFF has no hard cases. Errors: check, naming the first failure, after the
/// files are written; usage, in a program without hard cases.
void check_hard_cases(const HardCasesRequest& request);

}  // namespace footprint
