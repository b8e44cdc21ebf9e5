// What each method costs on GPUs: its programs compiled by a driver, with the loop counts of the frame.
#pragma once

#include <span>

#include "experiments/settings/run_settings.hpp"
#include "renderer/core/progress.hpp"
#include "renderer/gpu_cost/compiled_programs.hpp"
#include "results/report/gpu_cost_report.hpp"

namespace footprint {

/// The costs of the settings' methods for one view of the scene. It lacks tool and backend.cpu.
/// Deterministic but for compile_seconds.
/// Errors: of scene, methods and settings (usage); of the machine; an interrupt through `progress`. A program that the
/// driver refuses costs its row.
[[nodiscard]] CostReport estimate_costs(const RunSettings& settings, std::span<const Chip* const> chips,
                                        const GpuCompiler& compile, const Progress& progress);

}  // namespace footprint
