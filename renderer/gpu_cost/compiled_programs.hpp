// Programs and what a driver's compiler makes of them, also as files: how a process that compiles gets its work and
// returns it.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renderer/core/gpu_chips.hpp"
#include "renderer/core/progress.hpp"
#include "renderer/gpu_cost/vulkan_compiler.hpp"

namespace footprint {

/// A raster program for OpenGL.
struct GlslProgram {
  std::string name;                      ///< for messages
  std::string vertex, fragment;          ///< the texts of its stages
  std::vector<ColorTarget> targets{{}};  ///< in the order of the outputs
};

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
/// Throws Error (machine): no driver; a program is not valid for Vulkan; an interrupt through `progress`.
using GpuCompiler =
    std::function<ChipOutcomes(const Chip& chip, std::span<const GlslProgram> programs, const Progress& progress)>;

/// Writes each program into `folder` as SPIR-V. Throws Error (machine): a program is not valid for Vulkan; the disk is
/// full.
void write_programs(std::span<const GlslProgram> programs, const std::filesystem::path& folder);

/// Compiles the programs of `folder` that have no outcome there, in their order, and writes each outcome next to it.
/// An outcome says "was interrupted" until its program is compiled, so that a crash leaves that.
/// Throws Error (machine): as vulkan_compiler.
void compile_programs(const std::filesystem::path& folder);

/// How many programs of `folder` have an outcome.
[[nodiscard]] std::size_t compiled_count(const std::filesystem::path& folder);

/// The outcomes of `folder`. Throws Error (machine): one is missing.
[[nodiscard]] ChipOutcomes read_outcomes(const std::filesystem::path& folder, std::size_t count);

}  // namespace footprint
