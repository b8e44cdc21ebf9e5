// A second compiler for translated shaders: HLSL by glslang's own front end, and back to GLSL.
#pragma once

#include <string>

namespace footprint::test {

/// A fragment shader of HLSL as GLSL 4.50. Each pair of texture T and sampler is a sampler SPIRV_Cross_CombinedT... .
/// Members of constant buffers are members of plain structures; what HLSL calls `uniforms_NAME` is `uniforms.NAME`.
/// Throws std::runtime_error with the compiler's log.
[[nodiscard]] std::string glsl_of_hlsl(const std::string& hlsl);

}  // namespace footprint::test
