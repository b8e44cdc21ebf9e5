// Stands for spirv.cpp and translation.cpp in a build without compilers: nothing can be compiled or translated.
#include "renderer/languages/compilers.hpp"
#include "renderer/languages/spirv.hpp"
#include "renderer/languages/translation.hpp"

namespace footprint {

SpirvProgram spirv_program(const std::string& name, const std::string& /*vertex*/, const std::string& /*fragment*/) {
  throw missing_compilers(name);
}

Spirv fragment_spirv(const std::string& name, const std::string& /*text*/) { throw missing_compilers(name); }

std::vector<ShaderInput> shader_inputs(const Spirv& /*code*/) { throw missing_compilers("the inputs of a shader"); }

std::string translate(const Spirv& /*code*/, ShaderLanguage language, const std::string& /*glsl*/) {
  throw missing_compilers(file_extension(language));
}

}  // namespace footprint
