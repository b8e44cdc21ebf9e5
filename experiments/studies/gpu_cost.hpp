// What each method costs on GPUs: its programs compiled by a driver, with the loop counts of the frame.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/settings/run_settings.hpp"
#include "experiments/studies/stage.hpp"
#include "renderer/core/progress.hpp"
#include "renderer/gpu_cost/compiled_programs.hpp"
#include "renderer/gpu_cost/estimate.hpp"
#include "results/report/gpu_cost_report.hpp"

namespace footprint {

/// A program, and how often it counts in a frame (WeighedWork::weight).
struct WeighedProgram {
  FixedTrips trips;
  double weight = 1;
};

/// The costs of a stage's methods. Stores what is compiled, so that further views only count again.
class GpuCosts {
 public:
  /// Keeps the stage's address.
  /// gpus: as chips_named takes them.
  /// Throws Error (usage): no such GPU; (machine): no driver.
  GpuCosts(const Stage& stage, const std::vector<std::string>& gpus, GpuCompiler compile);

  /// The costs of a method that can be drawn, for one view. A program that the driver refuses costs the figures of its
  /// GPU. Throws Error (machine): the program is not valid for Vulkan; an interrupt through `progress`.
  [[nodiscard]] MethodCosts costs(const StagedMethod& method, const View& view, const Progress& progress);

  /// The driver's name of itself.
  [[nodiscard]] const std::string& compiler() const { return compiler_; }

 private:
  struct CompilingChip {
    const Chip* chip;
    int between_descriptors;
    std::map<std::pair<std::string, FixedTrips>, CompileOutcome> compiled;  // by method and footprint filter
  };
  void compile_missing(CompilingChip& chip, const StagedMethod& method, const std::vector<WeighedProgram>& programs,
                       const Progress& progress);
  [[nodiscard]] MethodCosts own_costs(const StagedMethod& method, const View& view, const Progress& progress);
  [[nodiscard]] static GpuCost cost_of(const CompilingChip& chip, const StagedMethod& method, double lookups,
                                       const std::vector<WeighedProgram>& programs,
                                       const std::map<int, TextureCost>& textures);

  const Stage& stage_;
  GpuCompiler compile_;
  std::string compiler_;
  std::vector<CompilingChip> chips_;
  std::optional<std::pair<View, MethodCosts>> unit_;  // of the last view
};

/// The costs of the settings' methods on their GPUs, for one view of the scene. It lacks tool and backend.cpu.
/// Deterministic but for compile_seconds.
/// Errors: of scene, methods and settings (usage); of the machine; an interrupt through `progress`. A method that fails
/// costs its row.
[[nodiscard]] CostReport estimate_costs(const RunSettings& settings, const GpuCompiler& compile,
                                        const Progress& progress);

}  // namespace footprint
