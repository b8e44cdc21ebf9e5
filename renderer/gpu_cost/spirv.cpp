// Compiles by glslang in this process, with the OpenGL bindings moved to where Vulkan's do not collide.
#include "renderer/gpu_cost/spirv.hpp"

#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>

#include "renderer/core/error.hpp"

namespace footprint {
namespace {

constexpr auto messages = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules);

// glslang's tables live as long as the process that uses them.
void start_glslang() {
  static const bool started = glslang::InitializeProcess();
  if (!started) throw Error(ErrorKind::machine, "glslang", "cannot be initialised");
}

Error invalid(const std::string& name, const char* log) {
  return {ErrorKind::machine, name, std::string("not valid for Vulkan: ") + log};
}

void parse(glslang::TShader& shader, EShLanguage stage, const std::string& name, const std::string& text) {
  const char* const source = text.c_str();
  shader.setStrings(&source, 1);
  shader.setEnvInput(glslang::EShSourceGlsl, stage, glslang::EShClientVulkan, 100);
  shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_1);
  shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_3);
  shader.setEnvInputVulkanRulesRelaxed();
  shader.setShiftBinding(glslang::EResUbo, vulkan_binding::first_block);
  shader.setGlobalUniformBinding(vulkan_binding::plain_uniforms - vulkan_binding::first_block);
  shader.setAutoMapLocations(true);
  shader.setAutoMapBindings(true);
  if (!shader.parse(GetDefaultResources(), 450, false, messages)) throw invalid(name, shader.getInfoLog());
}

}  // namespace

SpirvProgram spirv_program(const std::string& name, const std::string& vertex, const std::string& fragment) {
  start_glslang();
  glslang::TShader vertex_stage(EShLangVertex), fragment_stage(EShLangFragment);
  parse(vertex_stage, EShLangVertex, name, vertex);
  parse(fragment_stage, EShLangFragment, name, fragment);
  glslang::TProgram program;
  program.addShader(&vertex_stage);
  program.addShader(&fragment_stage);
  if (!program.link(messages) || !program.mapIO()) throw invalid(name, program.getInfoLog());
  SpirvProgram compiled;
  glslang::GlslangToSpv(*program.getIntermediate(EShLangVertex), compiled.vertex);
  glslang::GlslangToSpv(*program.getIntermediate(EShLangFragment), compiled.fragment);
  return compiled;
}

}  // namespace footprint
