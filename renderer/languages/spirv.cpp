// Compiles by glslang in this process, with the OpenGL bindings moved to where Vulkan's do not collide.
#include "renderer/languages/spirv.hpp"

#include <fmt/format.h>
#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>

#include <glslang/SPIRV/spirv.hpp>
#include <regex>

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

// The first bindings of blocks and of plain uniforms.
struct BlockBindings {
  std::uint32_t first_block = 0, plain_uniforms = 0;
};

void parse(glslang::TShader& shader, EShLanguage stage, const std::string& name, const std::string& text,
           const BlockBindings& bindings) {
  const char* const source = text.c_str();
  shader.setStrings(&source, 1);
  shader.setEnvInput(glslang::EShSourceGlsl, stage, glslang::EShClientVulkan, 100);
  shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_1);
  shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_3);
  shader.setEnvInputVulkanRulesRelaxed();
  shader.setShiftBinding(glslang::EResUbo, bindings.first_block);
  shader.setGlobalUniformBinding(bindings.plain_uniforms - bindings.first_block);
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

// Binds the textures, in their order, from 1. glslang's own choice may give one the binding of the block, which is 0.
std::string with_bound_textures(const std::string& text) {
  static const std::regex declaration(R"(\nuniform sampler)");
  std::string out;
  int binding = 0;
  auto at = text.begin();
  for (std::sregex_iterator found(text.begin(), text.end(), declaration), end; found != end; ++found) {
    out.append(at, (*found)[0].first);
    out += fmt::format("\nlayout(binding = {}) uniform sampler", ++binding);
    at = (*found)[0].second;
  }
  return out.append(at, text.end());
}

void link(glslang::TProgram& program, const std::string& name) {
  if (!program.link(messages) || !program.mapIO()) throw invalid(name, program.getInfoLog());
}

Spirv spirv_of(const glslang::TProgram& program, EShLanguage stage) {
  Spirv code;
  glslang::GlslangToSpv(*program.getIntermediate(stage), code);
  return code;
}

}  // namespace

SpirvProgram spirv_program(const std::string& name, const std::string& vertex, const std::string& fragment) {
  constexpr BlockBindings bindings{vulkan_binding::first_block, vulkan_binding::plain_uniforms};
  start_glslang();
  glslang::TShader vertex_stage(EShLangVertex), fragment_stage(EShLangFragment);
  parse(vertex_stage, EShLangVertex, name, vertex, bindings);
  parse(fragment_stage, EShLangFragment, name, fragment, bindings);
  glslang::TProgram program;
  program.addShader(&vertex_stage);
  program.addShader(&fragment_stage);
  link(program, name);
  SpirvProgram stages{.vertex = spirv_of(program, EShLangVertex), .fragment = spirv_of(program, EShLangFragment)};
  request_unrolling(stages.vertex);
  request_unrolling(stages.fragment);
  return stages;
}

Spirv fragment_spirv(const std::string& name, const std::string& text) {
  start_glslang();
  glslang::TShader stage(EShLangFragment);
  const std::string bound = with_bound_textures(text);
  parse(stage, EShLangFragment, name, bound, {});
  glslang::TProgram program;
  program.addShader(&stage);
  link(program, name);
  return spirv_of(program, EShLangFragment);
}

}  // namespace footprint
