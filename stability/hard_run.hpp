// Runs every method through every hard case and says of each whether it held.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "renderer/core/options.hpp"
#include "renderer/core/progress.hpp"
#include "renderer/gl/context.hpp"
#include "stability/known_limits.hpp"

namespace footprint::stability {

enum class Verdict {
  held,          ///< within the case's own bound
  guarded,       ///< within what a known limit grants to a guard
  out_of_range,  ///< within what a known limit says of it
  fell,          ///< neither, or within the bound although a limit is listed
};

/// One figure of one method in one case.
struct HardRow {
  std::string method;     ///< as on the command line
  std::string hard_case;  ///< by its name
  std::string group;      ///< column of the table
  std::string what;       ///< the case in words
  std::string figure;     ///< finite, energy, limit, direct, twin, mean, coat, step, threads or backends
  double value = 0.0, bound = 0.0;
  Verdict verdict = Verdict::held;
  std::string why{};      ///< of a known limit, or what fell
  std::string picture{};  ///< relative to the run's folder; of what did not hold, where there is one to see
};

struct HardSettings {
  gl::ContextRequest context;
  std::vector<MethodSpec> methods;  ///< empty: all of the registry
  bool wide = false;  ///< every storage in every case, not in those of single lobes alone; and cases that cost much
};

/// The rows in the order of methods and cases. Errors: those of contexts and bakes; those of `progress`.
[[nodiscard]] std::vector<HardRow> run_hard_cases(const HardSettings& settings, const std::filesystem::path& folder,
                                                  const Progress& progress);

/// The verdict on a figure, and why; a bound that a value meets although the limits list it is one that fell.
void judge(HardRow& row, std::span<const KnownLimit> limits);

}  // namespace footprint::stability
