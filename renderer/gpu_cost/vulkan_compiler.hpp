// A Vulkan driver's compiler, without a GPU: pipelines are compiled and described, never run.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "renderer/languages/spirv.hpp"

namespace footprint {

/// What a driver reports about the compiled fragment stage (VK_KHR_pipeline_executable_properties).
struct CompiledStage {
  std::map<std::string, std::uint64_t> statistics;  ///< by the driver's names, such as "VGPRs"
  std::string code;                                 ///< ACO's intermediate code before register allocation
  double seconds = 0;                               ///< that the driver compiled both stages
};

/// The first device of the Vulkan driver that the loader finds. Mesa's driver for AMD creates a device without hardware
/// for the chip that the variable RADV_FORCE_FAMILY names; so a process has one chip. libvulkan is loaded at run time.
/// Nothing but pipelines is requested, because such a device answers nothing else.
class VulkanCompiler {
 public:
  /// Throws Error (machine): libvulkan, a driver or a device is missing, with the package to install.
  VulkanCompiler();
  VulkanCompiler(const VulkanCompiler&) = delete;
  VulkanCompiler& operator=(const VulkanCompiler&) = delete;
  ~VulkanCompiler();

  /// The driver's name of the device.
  [[nodiscard]] const std::string& device() const;

  /// Throws Error (machine): the driver refuses the program, or does not describe its code.
  [[nodiscard]] CompiledStage compile(const SpirvProgram& program) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace footprint
