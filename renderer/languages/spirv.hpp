// GLSL programs for OpenGL as SPIR-V for Vulkan.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "renderer/core/gpu_cost.hpp"

namespace footprint {

/// The bindings of a program in Vulkan's one descriptor set: textures have their OpenGL units, from 0.
namespace vulkan_binding {
inline constexpr std::uint32_t first_block = 64;     ///< an OpenGL uniform block b has binding first_block + b
inline constexpr std::uint32_t plain_uniforms = 90;  ///< the block of all uniforms outside of blocks
}  // namespace vulkan_binding

/// Words of SPIR-V 1.3.
using Spirv = std::vector<std::uint32_t>;

/// The stages of a raster program.
struct SpirvProgram {
  Spirv vertex, fragment;
  std::vector<ColorTarget> targets{{}};  ///< in the order of the outputs
};

/// Compiles and links both stages by glslang under its relaxed Vulkan rules, which accept plain uniforms.
/// name: of the program, for messages.
/// Throws Error (machine): a stage is not valid for Vulkan; the message has glslang's log.
[[nodiscard]] SpirvProgram spirv_program(const std::string& name, const std::string& vertex,
                                         const std::string& fragment);

/// Compiles a fragment shader for translation: its plain uniforms are one block at binding 0, its textures follow.
/// Throws as spirv_program.
[[nodiscard]] Spirv fragment_spirv(const std::string& name, const std::string& text);

}  // namespace footprint
