// A GPU driver's compiler in processes of its own, because a driver chooses its chip once and may crash.
#pragma once

#include "renderer/gpu_cost/compiled_programs.hpp"

namespace footprint {

/// The hidden subcommand that a compiling process runs.
inline constexpr const char* compile_command = "compile-for-gpu";

/// Starts this program for each chip with Mesa's driver for AMD and the chip's name in its environment. A process that
/// crashes is started again for the programs after the one that crashed it.
/// Throws Error (machine): the driver is not installed, with the package; a process cannot be started.
[[nodiscard]] GpuCompiler amd_compiler();

/// The same, but each outcome has the reason if the driver is missing or a process cannot be started.
[[nodiscard]] GpuCompiler amd_compiler_if_installed();

}  // namespace footprint
