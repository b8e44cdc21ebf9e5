// Compilation for a GPU without the GPU: a Vulkan driver's compiler, whose pipelines are described and never run; and
// programs and outcomes as files: how a process that compiles gets its work and returns it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renderer/core/progress.hpp"
#include "renderer/gpu_cost/estimate.hpp"
#include "renderer/languages/spirv.hpp"

namespace footprint {

/// The driver's name of a stage's count of instructions.
inline constexpr const char* instructions_statistic = "Instructions";

/// What a driver reports about the compiled fragment stage, and in one figure about the vertex stage before it
/// (VK_KHR_pipeline_executable_properties).
struct CompiledStage {
  std::map<std::string, std::uint64_t> statistics;  ///< by the driver's names, such as "VGPRs"
  std::uint64_t vertex_instructions = 0;            ///< of the vertex stage
  std::string code;                                 ///< ACO's intermediate code before register allocation
  double seconds = 0;                               ///< that the driver compiled both stages
};

/// A driver's compiler.
struct VulkanCompiler {
  std::string device;  ///< the driver's name of it
  /// Throws Error (machine): the driver refuses the program, or does not describe its code.
  std::function<CompiledStage(const SpirvProgram&)> compile;
};

/// Of the first device of the Vulkan driver that the loader finds. Mesa's driver for AMD creates a device without
/// hardware for the chip that the variable RADV_FORCE_FAMILY names; so a process has one chip. libvulkan is loaded at
/// run time. Nothing but pipelines is requested, because such a device answers nothing else.
/// Throws Error (machine): libvulkan, a driver or a device is missing, with the package to install.
[[nodiscard]] VulkanCompiler vulkan_compiler();

/// A compiled program, or why the driver failed.
struct CompileOutcome {
  std::optional<CompiledStage> stage = {};
  std::string failure;
};

/// The outcomes for a chip.
struct ChipOutcomes {
  std::string device = {};  ///< the driver's name of it
  std::vector<CompileOutcome> programs;
};

/// Compiles programs for one chip. A program at which the driver fails or crashes costs only its own outcome.
/// Throws Error (machine): no driver; an interrupt through `progress`.
using GpuCompiler =
    std::function<ChipOutcomes(const Chip& chip, std::span<const SpirvProgram> programs, const Progress& progress)>;

/// Writes each program into `folder`. Throws Error (machine): the disk is full.
void write_programs(std::span<const SpirvProgram> programs, const std::filesystem::path& folder);

/// Compiles the programs of `folder` that have no outcome there, in their order, and writes each outcome next to it.
/// An outcome says "was interrupted" until its program is compiled, so that a crash leaves that.
/// Throws Error (machine): as vulkan_compiler.
void compile_programs(const std::filesystem::path& folder);

/// How many programs of `folder` have an outcome.
[[nodiscard]] std::size_t compiled_count(const std::filesystem::path& folder);

/// The outcomes of `folder`. Throws Error (machine): one is missing.
[[nodiscard]] ChipOutcomes read_outcomes(const std::filesystem::path& folder, std::size_t count);

}  // namespace footprint
