// Buffers, textures, render targets, programs and the frame timer on the default backend.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "renderer/core/error.hpp"
#include "renderer/gl/context.hpp"
#include "renderer/gl/objects.hpp"

namespace footprint::gl {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr std::array<GLenum, 1> rgba32f = {GL_RGBA32F};

constexpr std::string_view deep_triangle_shader = R"(#version 450
uniform float depth;
void main() { gl_Position = vec4(4.0 * (gl_VertexID & 1) - 1.0, 4.0 * (gl_VertexID >> 1) - 1.0, depth, 1.0); })";

constexpr std::string_view plain_shader = R"(#version 450
uniform vec4 wanted;
layout(location = 0) out vec4 color;
void main() { color = wanted; })";

class Objects : public testing::Test {
 protected:
  void TearDown() override { EXPECT_NO_THROW(context_.check("the test")); }

  /// The Error that `make` gives; a test fails if it gives none.
  template <class Make>
  static Error error_of(const Make& make) {
    try {
      make();
    } catch (const Error& error) {
      return error;
    }
    ADD_FAILURE() << "there was no error";
    return {ErrorKind::check, "", ""};
  }

  Context context_{ContextRequest{.backend = Backend::egl}};
};

TEST_F(Objects, AHandleDeletesTheNameThatItOwns) {
  GLuint name = 0;
  VertexArray owner;
  {
    VertexArray first = VertexArray::make();
    name = first.name();
    VertexArray second(std::move(first));
    owner = std::move(second);
  }
  EXPECT_EQ(owner.name(), name);
  EXPECT_TRUE(api().IsVertexArray(name)) << "a handle that was moved from deleted it";
  owner = {};
  EXPECT_FALSE(api().IsVertexArray(name));
  const VertexArray next = VertexArray::make();  // the driver gives the name again
  owner = {};
  EXPECT_TRUE(api().IsVertexArray(next.name())) << "a handle deleted its name twice";
}

TEST_F(Objects, AMovedFromBufferLeavesTheNameAlone) {
  GLuint name = 0;
  {
    Buffer owner;
    {
      const std::array<std::byte, 4> bytes{};
      Buffer maker(bytes);
      name = maker.name();
      owner = std::move(maker);
    }
    EXPECT_EQ(owner.name(), name);
    EXPECT_TRUE(api().IsBuffer(name));
  }
  EXPECT_FALSE(api().IsBuffer(name));
}

TEST_F(Objects, ABufferHasItsBytesAndAnEmptyOneSixteenZeros) {
  const std::array<std::uint32_t, 3> numbers = {1, 0xFFFFFFFFu, 42};
  const Buffer buffer(std::as_bytes(std::span(numbers)));
  std::array<std::uint32_t, 3> back{};
  api().GetNamedBufferSubData(buffer.name(), 0, sizeof back, back.data());
  EXPECT_EQ(back, numbers);

  const Buffer empty{std::span<const std::byte>()};
  std::array<std::uint32_t, 4> zeros = {1, 1, 1, 1};
  api().GetNamedBufferSubData(empty.name(), 0, sizeof zeros, zeros.data());
  EXPECT_EQ(zeros, (std::array<std::uint32_t, 4>{}));
}

TEST_F(Objects, ATextureTakesTightRowsOfAnyWidthAtEachLevel) {
  Texture texture(GL_RGB8, 5, 3, 2);
  EXPECT_EQ(texture.width(), 5);
  EXPECT_EQ(texture.height(), 3);
  std::vector<std::uint8_t> base(45), half(6);  // 5 x 3 and 2 x 1 texels of 3 bytes
  std::iota(base.begin(), base.end(), std::uint8_t{1});
  std::iota(half.begin(), half.end(), std::uint8_t{200});
  texture.upload(0, 5, 3, GL_RGB, GL_UNSIGNED_BYTE, base.data());
  texture.upload(1, 2, 1, GL_RGB, GL_UNSIGNED_BYTE, half.data());

  std::vector<std::uint8_t> base_back(base.size()), half_back(half.size());
  api().PixelStorei(GL_PACK_ALIGNMENT, 1);
  api().GetTextureImage(texture.name(), 0, GL_RGB, GL_UNSIGNED_BYTE, static_cast<GLsizei>(base.size()),
                        base_back.data());
  api().GetTextureImage(texture.name(), 1, GL_RGB, GL_UNSIGNED_BYTE, static_cast<GLsizei>(half.size()),
                        half_back.data());
  EXPECT_EQ(base_back, base);
  EXPECT_EQ(half_back, half);
}

TEST_F(Objects, ATextureOfAnImpossibleSizeIsAMachineError) {
  const int limit = context_.info().max_texture_size;
  const std::array<std::array<int, 2>, 4> sizes = {{{limit + 1, 1}, {1, limit + 1}, {0, 8}, {8, -1}}};
  for (const auto& size : sizes) {
    const Error error = error_of([&] { const Texture texture(GL_RGBA32F, size[0], size[1]); });
    EXPECT_EQ(error.kind(), ErrorKind::machine);
    EXPECT_THAT(error.what(), HasSubstr(std::to_string(size[0]) + "x" + std::to_string(size[1])));
  }
  EXPECT_EQ(error_of([&] { const RenderTarget target(limit + 1, 8, rgba32f, true); }).kind(), ErrorKind::machine);
}

// 128 GiB. A GPU may have as much, so the error is a software driver's.
TEST_F(Objects, ATextureLargerThanTheDriverAllowsIsAMachineError) {
  if (!context_.info().software) GTEST_SKIP() << "a GPU may allocate 128 GiB";
  const Error error = error_of([] { const Texture texture(GL_RGBA32F, 8192, 8192, 1, 128); });
  EXPECT_EQ(error.kind(), ErrorKind::machine);
  EXPECT_THAT(error.what(), HasSubstr("8192x8192x128"));
  EXPECT_THAT(error.what(), HasSubstr("what one texture takes"));
}

TEST_F(Objects, AFailedAllocationIsReportedOnceAndLeavesDebugOutputOn) {
  // More levels than 4x4 texels have.
  EXPECT_EQ(error_of([] { const Texture texture(GL_RGBA32F, 4, 4, 9); }).kind(), ErrorKind::machine);
  EXPECT_TRUE(context_.take_debug_errors().empty());
  api().Enable(0xBADBAD);
  EXPECT_EQ(context_.take_debug_errors().size(), 1u);
}

TEST_F(Objects, ATargetThatCannotBeDrawnIntoIsAMachineError) {
  constexpr std::array<GLenum, 1> shared_exponent = {GL_RGB9_E5};
  const Error error = error_of([&] { const RenderTarget target(8, 4, shared_exponent, false); });
  EXPECT_EQ(error.kind(), ErrorKind::machine);
  EXPECT_THAT(error.what(), HasSubstr("8x4"));
  EXPECT_THAT(error.what(), HasSubstr("GL_FRAMEBUFFER_"));
}

TEST_F(Objects, ATargetReadsEachAttachmentWithAnyNumberOfChannels) {
  constexpr std::array<GLenum, 2> formats = {GL_RGBA32F, GL_R32F};
  const RenderTarget target(3, 2, formats, true);
  const std::array<float, 4> color = {1.5f, -2.5f, 3e6f, 0.25f};
  const float single = 9.75f;
  api().ClearNamedFramebufferfv(target.framebuffer(), GL_COLOR, 0, color.data());
  api().ClearNamedFramebufferfv(target.framebuffer(), GL_COLOR, 1, &single);
  for (int channels = 1; channels <= 4; ++channels) {
    std::vector<float> texels(static_cast<std::size_t>(channels * 6));
    target.read(0, channels, texels);
    for (std::size_t i = 0; i < texels.size(); ++i) EXPECT_EQ(texels[i], color[i % static_cast<std::size_t>(channels)]);
  }
  std::vector<float> texels(6);
  target.read(1, 1, texels);
  EXPECT_THAT(texels, testing::Each(single));
  EXPECT_THROW(target.read(2, 1, texels), std::logic_error);
  EXPECT_THROW(target.read(0, 4, texels), std::logic_error);
}

TEST_F(Objects, TheDepthBufferHidesWhatIsBehind) {
  const RenderTarget target(2, 2, rgba32f, true);
  const Program program("plain", deep_triangle_shader, plain_shader);
  const ScreenTriangle triangle;
  api().BindFramebuffer(GL_FRAMEBUFFER, target.framebuffer());
  api().Viewport(0, 0, 2, 2);
  api().Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  api().Enable(GL_DEPTH_TEST);
  api().UseProgram(program.name());
  // The second is behind the first by less than a 24-bit buffer resolves; depth runs from 0 to 1 in clip space too.
  for (const float step : {0.0f, 1.0f}) {
    api().Uniform1f(program.uniform("depth"), step * 0x1p-25f);
    api().Uniform4f(program.uniform("wanted"), 1.0f + step, 0.0f, 0.0f, 1.0f);
    triangle.draw();
  }
  std::vector<float> red(4);
  target.read(0, 1, red);
  EXPECT_THAT(red, testing::Each(1.0f));
  EXPECT_EQ(program.uniform("no_such_uniform"), -1);
}

// By its own name an array is its first element; members of blocks are bound, not set.
TEST_F(Objects, AProgramKnowsItsUniforms) {
  const Program program("uniforms", "#version 450\nvoid main() { gl_Position = vec4(0.0); }", R"(#version 450
layout(std140, binding = 0) uniform Block { float in_block; };
uniform vec2 steps[3];
uniform sampler2D map;
out vec4 color;
void main() { color = vec4(steps[int(in_block)], texture(map, steps[0]).xy); })");
  EXPECT_EQ(program.uniforms().at("map").type, static_cast<GLenum>(GL_SAMPLER_2D));
  EXPECT_EQ(program.uniforms().at("steps[2]").type, static_cast<GLenum>(GL_FLOAT_VEC2));
  EXPECT_EQ(program.uniform("steps"), program.uniform("steps[0]"));
  for (const char* const name : {"steps", "steps[1]", "steps[2]", "map"})
    EXPECT_EQ(program.uniform(name), api().GetUniformLocation(program.name(), name)) << name;
  EXPECT_EQ(program.uniforms().size(), 5U);
  EXPECT_EQ(program.uniform("in_block"), -1);
}

TEST_F(Objects, ABrokenShaderNamesItsLines) {
  constexpr std::string_view broken = R"(#version 450
out vec4 color;
void main() {
  float fine = 1.0;
  color = vec4(undeclared_thing);
})";
  const Error error = error_of([&] { const Program program("glossy", deep_triangle_shader, broken); });
  EXPECT_EQ(error.kind(), ErrorKind::machine);
  EXPECT_THAT(error.place(), HasSubstr("glossy"));
  EXPECT_THAT(error.what(), HasSubstr("fragment shader"));
  EXPECT_THAT(error.what(), HasSubstr("5 |   color = vec4(undeclared_thing);"));
  EXPECT_THAT(error.what(), Not(HasSubstr("float fine")));
}

TEST_F(Objects, ABrokenShaderOfSeveralPartsNamesTheRightOne) {
  constexpr std::string_view broken = R"(#version 450
float first() { return 1.0; }
#line 1 3
float second() {
  return broken_here;
}
out vec4 color;
void main() { color = vec4(first() + second()); })";
  const Error error = error_of([&] { const Program program("parts", deep_triangle_shader, broken); });
  EXPECT_THAT(error.what(), HasSubstr("3:2 |   return broken_here;"));
}

TEST_F(Objects, StagesThatDoNotFitAreAnError) {
  constexpr std::string_view wants_more = R"(#version 450
in vec3 never_written;
out vec4 color;
void main() { color = vec4(never_written, 1.0); })";
  const Error error = error_of([&] { const Program program("misfit", deep_triangle_shader, wants_more); });
  EXPECT_THAT(error.what(), HasSubstr("do not link"));
  EXPECT_THAT(error.what(), HasSubstr("never_written"));
  EXPECT_TRUE(context_.take_debug_errors().empty());
}

TEST_F(Objects, AComputeProgramRuns) {
  const Program program("squares", R"(#version 450
layout(local_size_x = 4) in;
layout(std430, binding = 0) buffer Squares { uint squares[]; };
void main() { squares[gl_GlobalInvocationID.x] = gl_GlobalInvocationID.x * gl_GlobalInvocationID.x; })");
  const std::array<std::uint32_t, 8> zeros{};
  const Buffer buffer(std::as_bytes(std::span(zeros)));
  api().UseProgram(program.name());
  api().BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffer.name());
  api().DispatchCompute(2, 1, 1);
  api().MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  std::array<std::uint32_t, 8> squares{};
  api().GetNamedBufferSubData(buffer.name(), 0, sizeof squares, squares.data());
  EXPECT_EQ(squares, (std::array<std::uint32_t, 8>{0, 1, 4, 9, 16, 25, 36, 49}));
}

TEST_F(Objects, ATrilinearSamplerWrapsAsRequested) {
  const Sampler sampler = trilinear_sampler(GL_REPEAT, GL_CLAMP_TO_EDGE);
  const auto parameter = [&](GLenum name) {
    GLint value = 0;
    api().GetSamplerParameteriv(sampler.name(), name, &value);
    return value;
  };
  EXPECT_EQ(parameter(GL_TEXTURE_MAG_FILTER), GL_LINEAR);
  EXPECT_EQ(parameter(GL_TEXTURE_MIN_FILTER), GL_LINEAR_MIPMAP_LINEAR);
  EXPECT_EQ(parameter(GL_TEXTURE_WRAP_S), GL_REPEAT);
  EXPECT_EQ(parameter(GL_TEXTURE_WRAP_T), GL_CLAMP_TO_EDGE);
}

TEST_F(Objects, TheFrameTimerMeasuresByClockAndByQuery) {
  const RenderTarget target(64, 64, rgba32f, false);
  const std::array<float, 4> color = {1.0f, 1.0f, 1.0f, 1.0f};
  for (const bool software : {true, false}) {
    ContextInfo info = context_.info();
    info.software = software;
    FrameTimer timer(info);
    for (int frame = 0; frame < 3; ++frame) {
      timer.begin();
      api().ClearNamedFramebufferfv(target.framebuffer(), GL_COLOR, 0, color.data());
      const double ms = timer.end_ms();
      EXPECT_TRUE(std::isfinite(ms));
      EXPECT_GE(ms, 0.0);
    }
  }
}

}  // namespace
}  // namespace footprint::gl
