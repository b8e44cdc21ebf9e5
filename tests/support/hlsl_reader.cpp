// glslang's HLSL front end shares no code with SPIRV-Cross's HLSL back end.
#include "tests/support/hlsl_reader.hpp"

#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>
#include <spirv_cross/spirv_cross_c.h>

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <vector>

namespace footprint::test {
namespace {

std::vector<std::uint32_t> spirv_of_hlsl(const std::string& hlsl) {
  static const bool started = glslang::InitializeProcess();
  constexpr auto messages = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules | EShMsgReadHlsl);
  const char* const source = hlsl.c_str();
  glslang::TShader shader(EShLangFragment);
  shader.setStrings(&source, 1);
  shader.setEnvInput(glslang::EShSourceHlsl, EShLangFragment, glslang::EShClientVulkan, 100);
  shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_1);
  shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_3);
  shader.setEntryPoint("main");
  shader.setShiftBinding(glslang::EResSampler, 32);
  shader.setShiftBinding(glslang::EResUbo, 64);
  if (!started || !shader.parse(GetDefaultResources(), 500, false, messages))
    throw std::runtime_error(shader.getInfoLog());
  glslang::TProgram program;
  program.addShader(&shader);
  if (!program.link(messages) || !program.mapIO()) throw std::runtime_error(program.getInfoLog());
  std::vector<std::uint32_t> code;
  // The optimizer makes HLSL legal: it inlines functions that are given textures.
  glslang::SpvOptions options;
  options.disableOptimizer = false;
  glslang::GlslangToSpv(*program.getIntermediate(EShLangFragment), code, &options);
  return code;
}

// Members lose the prefix that SPIRV-Cross gave them for HLSL, which has no names of blocks.
void name_members(spvc_compiler compiler, const spvc_reflected_resource& block) {
  spvc_compiler_set_name(compiler, block.id, "uniforms");
  const spvc_type type = spvc_compiler_get_type_handle(compiler, block.base_type_id);
  for (unsigned i = 0; i < spvc_type_get_num_member_types(type); ++i) {
    const std::string name = spvc_compiler_get_member_name(compiler, block.base_type_id, i);
    spvc_compiler_set_member_name(compiler, block.base_type_id, i, name.substr(name.find('_') + 1).c_str());
  }
}

void join_samplers(spvc_compiler compiler) {
  spvc_variable_id none = 0;
  spvc_compiler_build_dummy_sampler_for_combined_images(compiler, &none);
  spvc_compiler_build_combined_image_samplers(compiler);
  const spvc_combined_image_sampler* pairs = nullptr;
  std::size_t count = 0;
  spvc_compiler_get_combined_image_samplers(compiler, &pairs, &count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::string texture = spvc_compiler_get_name(compiler, pairs[i].image_id);
    const std::string name = "SPIRV_Cross_Combined" + texture + "_" + std::to_string(i);
    spvc_compiler_set_name(compiler, pairs[i].combined_id, name.c_str());
    spvc_compiler_set_decoration(compiler, pairs[i].combined_id, SpvDecorationBinding, static_cast<unsigned>(i));
  }
}

}  // namespace

std::string glsl_of_hlsl(const std::string& hlsl) {
  const std::vector<std::uint32_t> code = spirv_of_hlsl(hlsl);
  spvc_context context = nullptr;
  spvc_context_create(&context);
  const std::unique_ptr<std::remove_pointer_t<spvc_context>, void (*)(spvc_context)> owner(context,
                                                                                           spvc_context_destroy);
  spvc_parsed_ir parsed = nullptr;
  spvc_compiler compiler = nullptr;
  spvc_compiler_options options = nullptr;
  spvc_resources resources = nullptr;
  spvc_context_parse_spirv(context, code.data(), code.size(), &parsed);
  spvc_context_create_compiler(context, SPVC_BACKEND_GLSL, parsed, SPVC_CAPTURE_MODE_TAKE_OWNERSHIP, &compiler);
  spvc_compiler_create_shader_resources(compiler, &resources);
  const spvc_reflected_resource* blocks = nullptr;
  std::size_t count = 0;
  spvc_resources_get_resource_list_for_type(resources, SPVC_RESOURCE_TYPE_UNIFORM_BUFFER, &blocks, &count);
  for (std::size_t i = 0; i < count; ++i) name_members(compiler, blocks[i]);
  join_samplers(compiler);
  spvc_compiler_create_compiler_options(compiler, &options);
  spvc_compiler_options_set_uint(options, SPVC_COMPILER_OPTION_GLSL_VERSION, 450);
  spvc_compiler_options_set_bool(options, SPVC_COMPILER_OPTION_GLSL_EMIT_UNIFORM_BUFFER_AS_PLAIN_UNIFORMS, SPVC_TRUE);
  spvc_compiler_install_compiler_options(compiler, options);
  const char* text = nullptr;
  if (spvc_compiler_compile(compiler, &text) != SPVC_SUCCESS)
    throw std::runtime_error(spvc_context_get_last_error_string(context));
  return text;
}

}  // namespace footprint::test
