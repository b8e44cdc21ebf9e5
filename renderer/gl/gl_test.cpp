// Contexts of every backend: what they give, that they live side by side, and how they fail.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <string>
#include <thread>

#include "renderer/core/error.hpp"
#include "renderer/gl/context.hpp"
#include "renderer/gl/objects.hpp"

namespace footprint::gl {
namespace {

using testing::HasSubstr;

constexpr std::array<Backend, 3> backends = {Backend::egl, Backend::egl_device, Backend::osmesa};
using Color = std::array<float, 4>;

/// Why the machine has no such backend; empty if it has.
std::string why_absent(Backend backend) {
  try {
    const Context context({.backend = backend});
    return {};
  } catch (const Error& error) {
    return error.what();
  }
}

std::vector<float> read(const RenderTarget& target) {
  std::vector<float> texels(4 * static_cast<std::size_t>(target.width() * target.height()));
  target.read(0, 4, texels);
  return texels;
}

RenderTarget cleared_target(const Color& color) {
  constexpr std::array<GLenum, 1> formats = {GL_RGBA32F};
  RenderTarget target(3, 5, formats, false);
  api().ClearNamedFramebufferfv(target.framebuffer(), GL_COLOR, 0, color.data());
  return target;
}

void expect_color(const RenderTarget& target, const Color& color) {
  const auto texels = read(target);
  for (std::size_t i = 0; i < texels.size(); ++i) EXPECT_EQ(texels[i], color[i % 4]) << "component " << i;
}

constexpr std::string_view triangle_shader = R"(#version 450
out vec2 uv;
void main() {
  uv = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0;
  gl_Position = vec4(2.0 * uv - 1.0, 0.0, 1.0);
})";

constexpr std::string_view waves_shader = R"(#version 450
in vec2 uv;
out vec4 color;
void main() {
  vec3 n = normalize(vec3(0.3 * sin(7.0 * uv.x), 0.3 * cos(5.0 * uv.y), 1.0));
  color = vec4(n, exp2(8.0 * (n.z - 1.0)));
})";

constexpr int waves_side = 32;

/// The image of waves_shader on the current context, 4 x 32 x 32 floats.
std::vector<float> draw_waves() {
  constexpr std::array<GLenum, 1> formats = {GL_RGBA32F};
  const RenderTarget target(waves_side, waves_side, formats, false);
  const Program program("waves", triangle_shader, waves_shader);
  api().UseProgram(program.name());
  ScreenTriangle().draw_into(target, waves_side, waves_side);
  return read(target);
}

/// What waves_shader says at a pixel, in double precision.
std::array<double, 4> expected_wave(int x, int y) {
  const double u = (x + 0.5) / waves_side, v = (y + 0.5) / waves_side;
  const double nx = 0.3 * std::sin(7.0 * u), ny = 0.3 * std::cos(5.0 * v);
  const double length = std::sqrt(nx * nx + ny * ny + 1.0);
  return {nx / length, ny / length, 1.0 / length, std::exp2(8.0 * (1.0 / length - 1.0))};
}

class EveryBackend : public testing::TestWithParam<Backend> {
 protected:
  void SetUp() override {
    const std::string reason = why_absent(GetParam());
    if (reason.empty()) return;
    ASSERT_NE(GetParam(), Backend::egl) << "EGL surfaceless must be there: " << reason;
    GTEST_SKIP() << reason;
  }
};

TEST_P(EveryBackend, GivesACore45Context) {
  const Context context({.backend = GetParam()});
  GLint major = 0, minor = 0, profile = 0;
  api().GetIntegerv(GL_MAJOR_VERSION, &major);
  api().GetIntegerv(GL_MINOR_VERSION, &minor);
  api().GetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
  EXPECT_GE(10 * major + minor, 45);
  EXPECT_EQ(profile, GL_CONTEXT_CORE_PROFILE_BIT);

  const ContextInfo& info = context.info();
  EXPECT_EQ(info.backend, GetParam());
  EXPECT_FALSE(info.vendor.empty());
  EXPECT_FALSE(info.renderer.empty());
  EXPECT_FALSE(info.glsl_version.empty());
  EXPECT_EQ(info.version.substr(0, 2), "4.");
  // The least that the OpenGL 4.5 specification allows (tables 23.54 to 23.64).
  EXPECT_GE(info.max_texture_size, 16384);
  EXPECT_GE(info.max_framebuffer_size, 16384);
  EXPECT_GE(info.max_uniform_block_bytes, 16384);
  EXPECT_GE(info.max_texture_units, 16);
  EXPECT_NO_THROW(context.check("making a context"));
}

TEST_P(EveryBackend, ClearsAFloatTargetToExactValues) {
  const Context context({.backend = GetParam()});
  for (const Color& color : {Color{0.1f, -3.5f, 1e20f, 1e-30f}, Color{65536.5f, 0.0f, 1.0f / 3.0f, -1e-5f}}) {
    expect_color(cleared_target(color), color);
  }
  EXPECT_NO_THROW(context.check("clearing"));
}

TEST_P(EveryBackend, CollectsAnErrorAndThrowsItOnce) {
  const Context context({.backend = GetParam()});
  api().Enable(0xBADBAD);
  try {
    context.check("testing the debug output");
    FAIL() << "the error was not collected";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::machine);
    EXPECT_THAT(error.what(), HasSubstr("testing the debug output"));
    EXPECT_THAT(error.what(), HasSubstr("GL_INVALID_ENUM"));
  }
  EXPECT_NO_THROW(context.check("testing the debug output"));
}

TEST_P(EveryBackend, KeepsOnlyTheFirstOfManyErrors) {
  const Context context({.backend = GetParam()});
  for (int i = 0; i < 1000; ++i) api().Enable(0xBADBAD);
  const auto errors = context.take_debug_errors();
  EXPECT_GE(errors.size(), 2u);
  EXPECT_LT(errors.size(), 100u);
  EXPECT_TRUE(context.take_debug_errors().empty());
}

TEST_P(EveryBackend, DrawsWhatTheShaderSays) {
  const Context context({.backend = GetParam()});
  const auto image = draw_waves();
  for (std::size_t i = 0; i < image.size(); ++i) {
    const auto texel = static_cast<int>(i / 4);
    EXPECT_NEAR(image[i], expected_wave(texel % waves_side, texel / waves_side)[i % 4], 1e-4);
  }
  EXPECT_NO_THROW(context.check("drawing"));
}

INSTANTIATE_TEST_SUITE_P(Backends, EveryBackend, testing::ValuesIn(backends), [](const auto& backend) {
  std::string name(backend_name(backend.param));
  std::ranges::replace(name, '-', '_');
  return name;
});

TEST(Backends, DrawTheSameImage) {
  std::map<std::string_view, std::vector<float>> images;
  for (const Backend backend : backends) {
    if (!why_absent(backend).empty()) continue;
    const Context context({.backend = backend});
    if (context.info().software) images.emplace(backend_name(backend), draw_waves());
  }
  if (images.size() < 2) GTEST_SKIP() << "fewer than two software backends are present";
  const auto& [first_name, first] = *images.begin();
  for (const auto& [name, image] : images) {
    ASSERT_EQ(image.size(), first.size());
    for (std::size_t i = 0; i < image.size(); ++i) {
      EXPECT_NEAR(image[i], first[i], 1e-6) << name << " against " << first_name;
    }
  }
}

// OSMesa of Mesa 22.3 crashes where the variable names a driver that needs a device; a user who sets it does not mean
// OSMesa.
TEST(Backends, OsMesaKeepsToItsOwnDriver) {
  if (const auto reason = why_absent(Backend::osmesa); !reason.empty()) GTEST_SKIP() << reason;
  const char* before = std::getenv("GALLIUM_DRIVER");
  const std::optional<std::string> original = before == nullptr ? std::nullopt : std::optional<std::string>(before);
  setenv("GALLIUM_DRIVER", "zink", 1);
  EXPECT_TRUE(Context({.backend = Backend::osmesa}).info().software);
  EXPECT_STREQ(std::getenv("GALLIUM_DRIVER"), "zink") << "it is hidden for others too";
  original ? setenv("GALLIUM_DRIVER", original->c_str(), 1) : unsetenv("GALLIUM_DRIVER");
}

TEST(SoftwareRenderers, AreKnownByMoreNamesThanOne) {
  for (const char* name :
       {"llvmpipe (LLVM 15.0.6, 256 bits)", "zink (llvmpipe (LLVM 15.0.6, 256 bits))", "softpipe", "Mesa swrast",
        "ANGLE (Google, Vulkan 1.3.0 (SwiftShader Device (Subzero) (0x0000C0DE)), SwiftShader driver)",
        "D3D12 (Microsoft Basic Render Driver)", "GDI Generic", "Apple Software Renderer", "Software Rasterizer"})
    EXPECT_TRUE(is_software_renderer(name)) << name;
  for (const char* name : {"NVIDIA H200/PCIe/SSE2", "AMD Radeon RX 6800 (radeonsi, navi21, LLVM 15.0.6, DRM 3.49)",
                           "zink (NVIDIA GeForce RTX 3080)", "Mesa Intel(R) UHD Graphics 620 (KBL GT2)", "virgl", ""})
    EXPECT_FALSE(is_software_renderer(name)) << name;
}

TEST(Backends, LiveSideBySide) {
  for (const Backend other : {Backend::egl, Backend::egl_device, Backend::osmesa}) {
    if (!why_absent(other).empty()) continue;
    const Color red = {1.0f, 0.0f, 0.0f, 1.0f}, blue = {0.0f, 0.0f, 7.0f, 0.5f};
    const Context one({.backend = Backend::egl});
    const RenderTarget red_target = cleared_target(red);
    {
      const Context two({.backend = other});
      const RenderTarget blue_target = cleared_target(blue);
      one.make_current();
      expect_color(red_target, red);
      two.make_current();
      expect_color(blue_target, blue);
      api().Enable(0xBADBAD);
      one.make_current();
      EXPECT_NO_THROW(one.check("an error of the other context"));
      two.make_current();
      EXPECT_THROW(two.check("its own error"), Error);
    }
    // The other one is gone, its display too unless it is shared; this one must not have suffered.
    EXPECT_FALSE(has_current_context());
    one.make_current();
    expect_color(red_target, red);
    expect_color(cleared_target(blue), blue);
    EXPECT_NO_THROW(one.check("drawing on"));
  }
}

TEST(Backends, WorkOnThreadsOfTheirOwn) {
  const auto work = [](float value) {
    for (int round = 0; round < 3; ++round) {
      const Context context({.backend = Backend::egl});
      expect_color(cleared_target({value, 0.0f, 0.0f, 1.0f}), {value, 0.0f, 0.0f, 1.0f});
    }
  };
  std::jthread other(work, 2.0f);
  work(3.0f);
}

TEST(Backends, AutoTakesTheFirst) { EXPECT_EQ(Context({}).info().backend, Backend::egl); }

TEST(Backends, AFailedContextLeavesTheCurrentOneAlone) {
  const Context context({.backend = Backend::egl});
  EXPECT_THROW(Context({.backend = Backend::egl_device, .device = 12345}), Error);
  expect_color(cleared_target({1.0f, 2.0f, 3.0f, 4.0f}), {1.0f, 2.0f, 3.0f, 4.0f});
}

TEST(Backends, AContextMoves) {
  Context first({.backend = Backend::egl});
  Context second(std::move(first));
  EXPECT_EQ(second.info().backend, Backend::egl);
  expect_color(cleared_target({1.0f, 2.0f, 3.0f, 4.0f}), {1.0f, 2.0f, 3.0f, 4.0f});
  second = Context({.backend = Backend::egl});
  expect_color(cleared_target({5.0f, 6.0f, 7.0f, 8.0f}), {5.0f, 6.0f, 7.0f, 8.0f});
}

TEST(Backends, WithoutAContextACallIsAnErrorAndADeletionIsNot) {
  RenderTarget orphan;
  {
    const Context context({.backend = Backend::egl});
    orphan = cleared_target({1.0f, 1.0f, 1.0f, 1.0f});
  }
  EXPECT_FALSE(has_current_context());
  EXPECT_THROW(static_cast<void>(api()), std::logic_error);
}

TEST(Backends, AreProbedWithoutDisturbingTheCurrentContext) {
  const Context context({.backend = Backend::egl});
  const auto reports = probe_backends();
  for (const Backend backend : backends) {
    EXPECT_TRUE(std::ranges::any_of(reports, [&](const auto& report) { return report.backend == backend; }));
  }
  for (const BackendReport& report : reports) {
    EXPECT_NE(report.info.has_value(), !report.why_not.empty()) << backend_name(report.backend);
    EXPECT_TRUE(report.info || report.backend != Backend::egl) << report.why_not;
    EXPECT_TRUE(!report.info || report.info->backend == report.backend);
  }
  expect_color(cleared_target({1.0f, 2.0f, 3.0f, 4.0f}), {1.0f, 2.0f, 3.0f, 4.0f});
}

/// The Error that opening a context gives.
Error error_of(const ContextRequest& request) {
  try {
    const Context context(request);
  } catch (const Error& error) {
    return error;
  }
  ADD_FAILURE() << "there was no error";
  return {ErrorKind::check, "", ""};
}

TEST(Backends, ADeviceOutOfRangeIsAUsageError) {
  if (const auto reason = why_absent(Backend::egl_device); !reason.empty()) GTEST_SKIP() << reason;
  for (const int device : {-1, 12345}) {
    const Error error = error_of({.backend = Backend::egl_device, .device = device});
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    EXPECT_THAT(error.what(), HasSubstr(std::to_string(device)));
    EXPECT_THAT(error.hint(), HasSubstr("footprint info"));
  }
}

TEST(Backends, ADeviceOfABackendWithoutDevicesIsAUsageError) {
  EXPECT_EQ(error_of({.backend = Backend::egl, .device = 1}).kind(), ErrorKind::usage);
  EXPECT_THAT(error_of({.backend = {}, .device = 1}).hint(), HasSubstr("egl-device"));
}

TEST(BackendWords, NameEachAndNoneForAuto) {
  EXPECT_EQ(word_value(backend_words, "auto", "backend", ""), std::nullopt);
  for (const Backend backend : backends) EXPECT_EQ(word_value(backend_words, backend_name(backend), "", ""), backend);
  try {
    static_cast<void>(word_value(backend_words, "omesa", "backend", "--backend"));
    FAIL() << "an unknown backend was taken";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    EXPECT_THAT(error.what(), HasSubstr("--backend: unknown backend `omesa`"));
    EXPECT_THAT(error.hint(), HasSubstr("did you mean `osmesa`"));
  }
}

}  // namespace
}  // namespace footprint::gl
