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
#include "results/report/command_reports.hpp"

namespace footprint {

/// A program as a driver compiles it.
struct CostedProgram {
  std::string vertex, fragment;  ///< GLSL for OpenGL
  std::vector<ColorTarget> targets{{}};

  friend auto operator<=>(const CostedProgram&, const CostedProgram&) = default;
};

/// The work of a method's frame on any GPU.
struct CostedFrame {
  std::string name;  ///< of the method, for messages
  /// Each with how often it counts in a frame (WeighedWork::weight); one with a single round per loop first.
  std::vector<std::pair<CostedProgram, double>> programs;
  std::map<int, ReadTexture> textures;  ///< by unit
  RecordedDraws passes;                 ///< that each frame repeats before it draws
  PixelWork work;                       ///< counted on the software renderer
};

/// The costs of a stage's methods. Stores what is compiled, so that further views only count again.
class GpuCosts {
 public:
  /// Keeps the stage's address.
  /// gpus: as chips_named takes them. A chip for which `compile` fails costs the figures of that GPU.
  /// Throws Error (usage): no such GPU; those of `compile`.
  GpuCosts(const Stage& stage, const std::vector<std::string>& gpus, GpuCompiler compile);

  /// The costs of a method that can be drawn, for one view. A program that the driver refuses costs the figures of its
  /// GPU. Throws Error (machine): the program is not valid for Vulkan; an interrupt through `progress`.
  [[nodiscard]] MethodCosts costs(const StagedMethod& method, const View& view, const Progress& progress);

  /// The driver's name of itself.
  [[nodiscard]] const std::string& compiler() const { return compiler_; }

 private:
  struct CompilingChip {
    const Chip* chip;
    std::string failure;  // why nothing can be compiled for it, or empty
    int between_descriptors;
    std::map<CostedProgram, CompileOutcome> compiled = {};
  };
  void compile_missing(CompilingChip& chip, const CostedFrame& frame, const Progress& progress);
  [[nodiscard]] MethodCosts own_costs(const StagedMethod& method, const View& view, const Progress& progress);
  [[nodiscard]] std::vector<std::pair<CostedProgram, double>> weighed_programs(const StagedMethod& method,
                                                                               const PixelTrips& trips) const;
  [[nodiscard]] static GpuCost cost_of(const CompilingChip& chip, const CostedFrame& frame);
  [[nodiscard]] static double passes_ns(const CompilingChip& chip, const CostedFrame& frame);

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
