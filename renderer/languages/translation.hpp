// Fragment shaders in other languages, by SPIRV-Cross, with the comments of their GLSL.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "renderer/core/names.hpp"
#include "renderer/languages/spirv.hpp"

namespace footprint {

/// The languages that a shader can be written in.
enum class ShaderLanguage {
  glsl,   ///< 4.50 core
  essl,   ///< OpenGL ES 3.1
  hlsl,   ///< shader model 5.0
  msl,    ///< Metal 2.0
  spirv,  ///< 1.3, for Vulkan: binary
};

inline constexpr auto shader_languages = std::to_array<Word<ShaderLanguage>>({{ShaderLanguage::glsl, "glsl"},
                                                                              {ShaderLanguage::essl, "essl"},
                                                                              {ShaderLanguage::hlsl, "hlsl"},
                                                                              {ShaderLanguage::msl, "msl"},
                                                                              {ShaderLanguage::spirv, "spirv"}});

/// The extension of a file: "spv" for SPIR-V, else the language's name.
[[nodiscard]] inline std::string file_extension(ShaderLanguage language) {
  return language == ShaderLanguage::spirv ? "spv" : std::string(word_for(shader_languages, language));
}

/// An input or output of a shader.
struct ShaderInput {
  std::string kind;  ///< "attribute", "texture", "uniform" or "output"
  std::string type;  ///< in GLSL's words: "vec3", "sampler2D"
  std::string name;  ///< in the shader's GLSL
  int place = 0;     ///< location, or of a texture its number among the textures
};

/// The inputs of a fragment shader, by SPIRV-Cross's reflection: attributes, textures, uniforms, outputs.
[[nodiscard]] std::vector<ShaderInput> shader_inputs(const Spirv& code);

/// Translates a shader of fragment_spirv. Plain uniforms are members of `uniforms`: a plain structure in GLSL and ESSL,
/// a constant buffer in HLSL and MSL. Comments at functions, structures and their members are taken from `glsl`, its
/// source.
/// language: not spirv.
/// Throws Error (machine): SPIRV-Cross refuses it, with its message.
[[nodiscard]] std::string translate(const Spirv& code, ShaderLanguage language, const std::string& glsl);

/// Inserts the comments of `glsl` before functions and structures of the same name in `text`, and behind members of
/// those structures. A comment is lines of `//` without indentation just above. Functions of one name get the first
/// comment, once.
/// text: a translation by SPIRV-Cross.
[[nodiscard]] std::string with_comments(const std::string& text, const std::string& glsl);

}  // namespace footprint
