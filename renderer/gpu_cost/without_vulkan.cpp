// Stands for vulkan_compiler.cpp in a build without compilers.
#include "renderer/gpu_cost/vulkan_compiler.hpp"
#include "renderer/languages/compilers.hpp"

namespace footprint {

VulkanCompiler vulkan_compiler() { throw missing_compilers("Vulkan"); }

}  // namespace footprint
