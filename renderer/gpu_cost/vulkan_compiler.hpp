// Compilation for a GPU without the GPU: a Vulkan driver's compiler, whose pipelines are described and never run.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>

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

/// The compiler of the first device of the Vulkan driver that the loader finds. Mesa's driver for AMD creates a device
/// without hardware for the chip that the variable RADV_FORCE_FAMILY names; so a process has one chip. libvulkan is
/// loaded at run time. Nothing but pipelines is requested, because such a device answers nothing else.
/// Throws Error (machine): libvulkan, a driver or a device is missing, with the package to install; or the build has no
/// compilers (compilers.hpp).
[[nodiscard]] VulkanCompiler vulkan_compiler();

}  // namespace footprint
