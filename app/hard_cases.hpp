// `footprint check hard_cases`: every method where numbers are hard.
#pragma once

#include <string>
#include <string_view>

#include "experiments/settings/run_settings.hpp"

namespace footprint {

/// In place of an experiment's name.
inline constexpr std::string_view hard_cases_name = "hard_cases";

struct HardCasesRequest {
  RunSettings run;  ///< its backend and methods
  bool wide = false;
  std::string output;
  bool quiet = false;
};

/// Writes stability.md, hard_cases.json and pictures of what did not hold. Errors (check): something fell, the first of
/// it; the files are written all the same.
void check_hard_cases(const HardCasesRequest& request);

}  // namespace footprint
