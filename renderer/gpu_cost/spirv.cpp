// Compiles by glslang in this process, with the OpenGL bindings moved to where Vulkan's do not collide.
#include "renderer/gpu_cost/spirv.hpp"

#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>
#include <glslang/SPIRV/spirv.hpp>

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

// Requests that each loop be unrolled. A driver leaves long loops as they are, and an instruction in a loop then counts
// once, however many rounds the loop has.
void request_unrolling(Spirv& code) {
  constexpr std::size_t header_words = 5, control = 3;
  for (std::size_t at = header_words; at < code.size(); at += code[at] >> spv::WordCountShift) {
    if ((code[at] & spv::OpCodeMask) == spv::OpLoopMerge) code[at + control] |= spv::LoopControlUnrollMask;
  }
}

Spirv spirv_of(const glslang::TProgram& program, EShLanguage stage) {
  Spirv code;
  glslang::GlslangToSpv(*program.getIntermediate(stage), code);
  request_unrolling(code);
  return code;
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
  return {.vertex = spirv_of(program, EShLangVertex), .fragment = spirv_of(program, EShLangFragment)};
}

}  // namespace footprint
