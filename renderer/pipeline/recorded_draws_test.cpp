// Draws of a frame build are recorded as OpenGL runs them.
#include "renderer/pipeline/recorded_draws.hpp"

#include <gtest/gtest.h>

#include <array>

#include "renderer/pipeline/shader_source.hpp"
#include "tests/support/rendering.hpp"

namespace footprint::testing {
namespace {

constexpr const char* two_targets =
    "#version 450 core\nlayout(binding = 3) uniform sampler2DArray finer;\nlayout(binding = 1) uniform sampler2D "
    "other;\n"
    "layout(location = 0) out vec4 coarse;\nlayout(location = 1) out vec4 guard;\n"
    "void main() {\n  coarse = texelFetch(finer, ivec3(0), 0);\n  guard = texelFetch(other, ivec2(0), 0);\n}\n";

gl::Framebuffer framebuffer_of(const gl::Texture& first, const gl::Texture& second) {
  gl::Framebuffer framebuffer = gl::Framebuffer::make();
  const GLuint name = framebuffer.name();
  gl::api().NamedFramebufferTexture(name, GL_COLOR_ATTACHMENT0, first.name(), 0);
  gl::api().NamedFramebufferTexture(name, GL_COLOR_ATTACHMENT1, second.name(), 0);
  constexpr std::array<GLenum, 2> buffers{GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
  gl::api().NamedFramebufferDrawBuffers(name, 2, buffers.data());
  return framebuffer;
}

TEST(RecordedDraws, HaveTextsTexturesTargetsAndPixels) {
  (void)shared_context();
  const gl::Texture finer(GL_RGBA32F, 16, 8, 3, 2), other(GL_R8, 4, 4), coarse(GL_RGBA16F, 8, 8), guard(GL_R32F, 8, 8);
  const gl::Framebuffer framebuffer = framebuffer_of(coarse, guard);
  const gl::Program program("two targets", screen_vertex_shader(), two_targets);
  const gl::ScreenTriangle triangle;
  for (const GLenum off : {GL_DEPTH_TEST, GL_CULL_FACE, GL_BLEND}) gl::api().Disable(off);
  gl::api().BindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
  gl::api().Viewport(0, 0, 7, 5);
  gl::api().BindTextureUnit(3, finer.name());
  gl::api().BindTextureUnit(1, other.name());
  gl::api().UseProgram(program.name());
  int drawn = 0;
  const auto draw = [&] {
    ++drawn;
    triangle.draw();
  };
  RecordedDraws record;
  draw_recorded(&record, program, 2, draw);
  draw_recorded(nullptr, program, 2, draw);
  record_copy(&record, coarse, 35);
  record_copy(nullptr, coarse, 35);
  shared_context().check("recording a draw");
  EXPECT_EQ(drawn, 2);
  ASSERT_EQ(record.size(), 2U);
  const RecordedDraw& first = record.front();
  EXPECT_EQ(first.fragment, two_targets);
  EXPECT_EQ(first.vertex, screen_vertex_shader());
  EXPECT_EQ(first.pixels, 7 * 5);
  EXPECT_EQ(first.lookups, 2);
  ASSERT_EQ(first.targets.size(), 2U);
  EXPECT_EQ(first.targets[0].bytes(), 8);
  EXPECT_EQ(first.targets[1].channels, 1);
  EXPECT_EQ(first.targets[1].bits, 32);
  ASSERT_EQ(first.textures.size(), 2U);
  EXPECT_EQ(first.textures.at(3).bits, 128);
  EXPECT_EQ(first.textures.at(3).bytes, (16 * 8 + 8 * 4 + 4 * 2) * 2 * 16);
  EXPECT_EQ(first.textures.at(1).bytes, 4 * 4);
  const RecordedDraw& copy = record.back();
  EXPECT_TRUE(copy.fragment.empty());
  EXPECT_EQ(copy.pixels, 35);
  EXPECT_EQ(copy.targets.at(0).bytes(), 8);
}

}  // namespace
}  // namespace footprint::testing
