// The text runs in a compute shader with one invocation for each three inputs.
#include "tests/support/shader_probe.hpp"

#include "renderer/gl/objects.hpp"
#include "tests/support/rendering.hpp"

namespace footprint::testing {

std::vector<glm::vec4> evaluate_glsl(const std::string& functions, const std::string& body,
                                     std::span<const std::array<glm::vec4, 3>> inputs) {
  const gl::Context& context = shared_context();
  const std::string text =
      "#version 450 core\nlayout(local_size_x = 1) in;\n"
      "layout(std430, binding = 0) readonly buffer Inputs { vec4 inputs[]; };\n"
      "layout(std430, binding = 1) writeonly buffer Outputs { vec4 outputs[]; };\n" +
      functions + "\nvec4 probe(vec4 a, vec4 b, vec4 c) {\n" + body +
      "\n}\nvoid main() {\n  uint i = gl_GlobalInvocationID.x;\n"
      "  outputs[i] = probe(inputs[3 * i], inputs[3 * i + 1], inputs[3 * i + 2]);\n}\n";
  const gl::Program program("probe", text);
  const gl::Buffer in(std::as_bytes(inputs));
  std::vector<glm::vec4> results(inputs.size());
  const gl::Buffer out(std::as_bytes(std::span(results)));
  gl::api().UseProgram(program.name());
  gl::api().BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, in.name());
  gl::api().BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, out.name());
  gl::api().DispatchCompute(static_cast<GLuint>(inputs.size()), 1, 1);
  gl::api().MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  gl::api().GetNamedBufferSubData(out.name(), 0, static_cast<GLsizeiptr>(results.size() * sizeof(glm::vec4)),
                                  results.data());
  context.check("evaluating GLSL");
  return results;
}

}  // namespace footprint::testing
