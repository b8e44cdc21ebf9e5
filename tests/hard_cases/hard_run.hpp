// Tests every method with every hard case.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "renderer/core/options.hpp"
#include "renderer/core/progress.hpp"
#include "renderer/core/run_folder.hpp"
#include "renderer/gl/context.hpp"
#include "tests/hard_cases/known_limits.hpp"

namespace footprint::hard_cases {

enum class Verdict {
  passed,        ///< within the case's own bound
  guarded,       ///< within a known limit that a guard causes
  out_of_range,  ///< within another known limit
  failed,        ///< beyond both; in software also within the bound although a limit is listed
};

/// One figure of one method in one case.
struct HardRow {
  std::string method;       ///< as on the command line
  std::string hard_case;    ///< its name
  std::string group;        ///< column of the table
  std::string description;  ///< the case in words
  std::string figure;  ///< finite, energy, limit, direct, twin, mean, coat, history, moving, step, threads or backends
  double value = 0.0, bound = 0.0;
  Verdict verdict = Verdict::passed;
  std::string why{};      ///< the reason of a known limit or of a failure
  std::string picture{};  ///< file relative to the run's folder, if the figure did not pass; may be empty
};

struct HardSettings {
  gl::ContextRequest context;
  std::vector<MethodSpec> methods;  ///< empty: all methods
  bool wide = false;  ///< every storage in every case instead of only those of single lobes, and slow cases
};

/// Runs all cases, writes images of failures into `folder`, and returns the rows by methods and cases. Errors: those of
/// contexts and bakes; those of `progress`.
[[nodiscard]] std::vector<HardRow> run_hard_cases(const HardSettings& settings, const RunFolder& folder,
                                                  const Progress& progress);

/// Sets a row's verdict and reason.
/// whole: `limits` were measured on this renderer: a listed value within its bound fails, so that the list stays true.
void judge(HardRow& row, std::span<const KnownLimit> limits, bool whole);

}  // namespace footprint::hard_cases
