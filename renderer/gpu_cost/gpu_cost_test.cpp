// Counts of programs that are known, by the driver's own compiler, and the arithmetic of an estimate. CTest sets the
// chip (RADV_FORCE_FAMILY).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "renderer/core/error.hpp"
#include "renderer/gpu_cost/estimate.hpp"
#include "renderer/gpu_cost/vulkan_compiler.hpp"
#include "renderer/languages/spirv.hpp"

namespace footprint {
namespace {

using testing::HasSubstr;

constexpr const char* vertex_text =
    "#version 450 core\nout vec4 place;\nvoid main() { place = vec4(gl_VertexID); gl_Position = vec4(0.0); }\n";

// A fragment stage that declares two textures and computes `color` by the statements.
std::string fragment_text(const std::string& statements) {
  return "#version 450 core\nin vec4 place;\nlayout(binding = 0) uniform sampler2D first;\n"
         "layout(binding = 1) uniform sampler2DArray second;\nlayout(location = 0) out vec4 color;\n"
         "uniform int count;\nvoid main() {\n  vec4 sum = place;\n" +
         statements + "  color = sum;\n}\n";
}

std::string repeated(int times, const std::string& statement) {
  std::string text;
  for (int i = 0; i < times; ++i) text += "  " + statement + "\n";
  return text;
}

// Compiles on the chip of this process.
class Driver : public testing::Test {
 protected:
  static const VulkanCompiler& compiler() {
    static const VulkanCompiler only = vulkan_compiler();
    return only;
  }

  static std::string code_of(const std::string& statements) {
    return compiler().compile(spirv_program("test", vertex_text, fragment_text(statements))).code;
  }

  static int between() {
    static const int bytes =
        descriptor_bytes(code_of("sum += textureLod(first, place.xy, 0.0) + textureLod(second, place.xyz, 0.0);\n"));
    return bytes;
  }

  static ShaderWork work_of(const std::string& statements) { return shader_work(code_of(statements), between()); }
};

TEST_F(Driver, CountsEachFetchAtItsTexture) {
  for (const int n : {1, 3, 8}) {
    const ShaderWork work = work_of(repeated(n, "sum = textureLod(first, sum.xy, 0.0) + place;") +
                                    repeated(2, "sum += textureLod(second, sum.xyz, 0.0);") +
                                    "  sum += texelFetch(first, ivec2(sum.xy), 0);\n");
    ASSERT_EQ(work.straight.textures.size(), 2U) << n;
    EXPECT_EQ(work.straight.textures.at(0).samples, n);
    EXPECT_EQ(work.straight.textures.at(0).loads, 1);
    EXPECT_EQ(work.straight.textures.at(1).samples, 2);
    EXPECT_EQ(work.straight.texture_reads(), n + 3);
  }
}

// The vertex shader has its own count, which the fragment shader does not change.
TEST_F(Driver, CountsTheVertexShaderByItself) {
  const auto counted = [](const std::string& vertex_statements, const std::string& statements) {
    const std::string vertex = "#version 450 core\nout vec4 place;\nvoid main() {\n  place = vec4(gl_VertexID);\n" +
                               vertex_statements + "  gl_Position = place;\n}\n";
    return compiler().compile(spirv_program("test", vertex.c_str(), fragment_text(statements))).vertex_instructions;
  };
  const std::uint64_t plain = counted("", "");
  EXPECT_GT(plain, 0U);
  EXPECT_EQ(counted("", repeated(8, "sum = textureLod(first, sum.xy, 0.0) + place;")), plain);
  EXPECT_GE(counted(repeated(16, "place.x = fma(place.x, place.y, place.z);"), ""), plain + 16);
}

TEST_F(Driver, CountsGathers) {
  const ShaderWork work = work_of("  sum = textureGather(first, sum.xy, 0) + textureGather(first, sum.xy, 1);\n");
  EXPECT_EQ(work.straight.textures.at(0).gathers, 2);
}

// n dependent multiply-adds of one channel are n instructions at full rate; n reciprocals are n at a quarter of it.
TEST_F(Driver, CountsArithmetic) {
  const auto multiply_adds = [](int n) { return work_of(repeated(n, "sum.x = sum.x * place.y + place.z;")); };
  const auto reciprocals = [](int n) { return work_of(repeated(n, "sum.x = 1.0 / (sum.x + place.y);")); };
  const double none = multiply_adds(0).straight.full;
  for (const int n : {16, 64}) {
    EXPECT_NEAR(multiply_adds(n).straight.full - none, n, 1) << n;
    EXPECT_EQ(reciprocals(n).straight.quarter, n);
  }
}

// The driver leaves a body of this length in a loop unless it is asked to unroll.
TEST_F(Driver, CountsEveryRoundOfAConstantLoop) {
  const std::string body = repeated(64, "sum.x = sum.x * place.y + place.z;");
  const double once = work_of(body).straight.full;
  const ShaderWork work = work_of("  for (int i = 0; i < 12; ++i) {\n" + body + "  }\n");
  EXPECT_NEAR(work.straight.full - once, 11 * 64, 2);
  EXPECT_EQ(work.looped.full, 0);
}

// A pass that draws into two targets: n multiply-adds for the second one count, unless it has no such target.
TEST_F(Driver, CountsTheWorkOfEachTarget) {
  const auto full = [](int n, std::vector<ColorTarget> targets) {
    SpirvProgram program =
        spirv_program("pass", vertex_text,
                      "#version 450 core\nin vec4 place;\nlayout(location = 0) out vec4 map[2];\nvoid main() {\n"
                      "  vec4 sum = place;\n  map[0] = sum;\n" +
                          repeated(n, "sum.x = sum.x * place.y + place.z;") + "  map[1] = sum;\n}\n");
    program.targets = std::move(targets);
    return shader_work(compiler().compile(program).code, between()).straight.full;
  };
  for (const ColorTarget target : {ColorTarget{.channels = 4, .bits = 32}, ColorTarget{.channels = 1, .bits = 16}}) {
    for (const int n : {16, 64}) {
      EXPECT_NEAR(full(n, {target, target}) - full(0, {target, target}), n, 1) << n;
      EXPECT_EQ(full(n, {target}), full(0, {target}));
    }
  }
}

TEST_F(Driver, KeepsLoopsOfUnknownLengthApart) {
  const ShaderWork work = work_of(
      "  sum += textureLod(first, sum.xy, 0.0);\n"
      "  for (int i = 0; i < count; ++i) sum += textureLod(second, vec3(sum.xy, i), 0.0);\n");
  EXPECT_EQ(work.straight.textures.at(0).samples, 1);
  EXPECT_EQ(work.looped.textures.at(1).samples, 1);
  EXPECT_FALSE(work.straight.textures.contains(1));
}

TEST_F(Driver, GivesEqualCodeForEqualPrograms) {
  const std::string statements = repeated(5, "sum = textureLod(first, sum.xy, 0.0) / (sum + 1.0);");
  EXPECT_EQ(code_of(statements), code_of(statements));
}

TEST(Spirv, NamesTheProgramAndTheLineOfAFault) {
  try {
    (void)spirv_program("broken", vertex_text, "#version 450 core\nvoid main() {\n  nothing();\n}\n");
    FAIL() << "compiled";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::machine);
    EXPECT_THAT(error.what(), HasSubstr("broken"));
    EXPECT_THAT(error.what(), HasSubstr("0:3"));
    EXPECT_THAT(error.what(), HasSubstr("nothing"));
  }
}

TEST(ShaderWork, RefusesTextThatIsNoCode) {
  EXPECT_THROW((void)shader_work("something else\n", 96), Error);
  EXPECT_THROW((void)descriptor_bytes("BB0\n\t v1: %1 = v_mul_f32 %2, %3\n"), Error);
}

const Chip& deck() { return *chips_named("--gpu", {"Steam Deck"}).front(); }

ShaderWork work_with(double full, double samples) {
  ShaderWork work;
  work.straight.full = full;
  if (samples > 0) work.straight.textures[0].samples = samples;
  return work;
}

// 8 units of 2 SIMDs at 1.6 GHz: an instruction of a wave takes 2 clocks of a SIMD, so 2 / 64 / 25.6 ns per pixel.
TEST(Estimate, IsTheLargestBound) {
  const std::map<int, ReadTexture> textures{{0, {.name = "map", .bits = 32, .trilinear = true, .bytes = 1e6}}};
  const GpuCost arithmetic = estimate(deck(), {{1, work_with(640, 1)}}, 1, textures);
  EXPECT_NEAR(arithmetic.arithmetic_ns, 640 * 2 / 64.0 / 25.6, 1e-12);
  EXPECT_EQ(arithmetic.bound, "arithmetic");
  const GpuCost reads = estimate(deck(), {{1, work_with(64, 100)}}, 100, textures);
  EXPECT_NEAR(reads.texture_ns, 100 * 2 / (4 * 8 * 1.6), 1e-12);
  EXPECT_NEAR(reads.bandwidth_ns, (100 * 1.25 * 4 + 8) / 88, 1e-12);
  EXPECT_EQ(reads.bytes_fetched, 100 * 8 * 4);
  EXPECT_EQ(reads.cost_ns, std::max(reads.texture_ns, reads.bandwidth_ns));
}

// A further round that takes work away would make the sum negative.
TEST(Estimate, RefusesProgramsThatDoNotAddUp) {
  EXPECT_FALSE(estimate(deck(), {{-5, work_with(850, 4)}, {6, work_with(1030, 5)}}, 10, {}).failure);
  const GpuCost dropped = estimate(deck(), {{-5, work_with(850, 4)}, {6, work_with(180, 0)}}, 10, {});
  EXPECT_THAT(dropped.failure.value(), HasSubstr("drops work"));
  EXPECT_EQ(dropped.cost_ns, 0);
}

// A pass that averages four texels of 16 bytes into one: each is read once. A copy reads and writes.
TEST(Estimate, OfAPassCountsWhatItWrites) {
  ShaderWork work;
  work.looped.textures[0].loads = 1;
  const std::map<int, ReadTexture> textures{{0, {.name = "map", .bits = 128, .trilinear = false, .bytes = 1e6}}};
  const GpuCost pass = estimate(deck(), {{1, work}}, 4, textures, 16);
  EXPECT_EQ(pass.bytes_from_memory, 4 * 16 + 16);
  EXPECT_NEAR(pass.bandwidth_ns, 80 / 88.0, 1e-12);
  EXPECT_EQ(pass.bound, "bandwidth");
  EXPECT_NEAR(copy_ns(deck(), 88e6), 2e6, 1e-6);
}

TEST(Estimate, ExtrapolatesLoopsFromOneRoundAndTwo) {
  // One round costs 100 instructions and one read, a further one 30 and one: 3.5 rounds are 175 and 3.5.
  const std::vector<WeighedWork> works{{-1.5, work_with(100, 1)}, {2.5, work_with(130, 2)}};
  double rounds = 0;
  const Instructions work = frame_work(works, 3.5, rounds);
  EXPECT_NEAR(work.full, 175, 1e-9);
  EXPECT_NEAR(work.texture_reads(), 3.5, 1e-9);
  EXPECT_EQ(rounds, 1);
}

TEST(Estimate, RunsRemainingLoopsUntilLookupsAgree) {
  ShaderWork work = work_with(100, 2);
  work.looped.full = 10;
  work.looped.textures[1].loads = 4;
  double rounds = 0;
  const Instructions frame = frame_work({{1, work}}, 42, rounds);
  EXPECT_EQ(rounds, 10);
  EXPECT_EQ(frame.full, 200);
  EXPECT_EQ(frame.texture_reads(), 42);
  EXPECT_EQ(frame_work({{1, work}}, 4, rounds).full, 105);  // half of the pixels skip the loop
  EXPECT_EQ(rounds, 0.5);
}

// The lines that bilinear samples touch, counted on a grid of samples `step` texels apart over a map that repeats.
double lines_counted(int step, int edge) {
  constexpr int samples = 64;
  std::set<std::pair<int, int>> lines;
  for (int y = 0; y < samples; ++y) {
    for (int x = 0; x < samples; ++x) {
      for (const int corner : {0, 1, 2, 3})
        lines.emplace((x * step + corner % 2) % (samples * step) / edge,
                      (y * step + corner / 2) % (samples * step) / edge);
    }
  }
  return static_cast<double>(lines.size()) / (samples * samples);
}

// Lines of 4 x 4 texels of 32 bits, of 2 x 2 of 128, and lines of 128 bytes of 4 x 4 texels of 64 bits. Odd steps meet
// lines at all places alike.
TEST(Estimate, OfAMinifiedMapFetchesTheLinesThatItsSamplesTouch) {
  struct Case {
    int edge;
    double texel_bytes, line_bytes;
  };
  for (const Case& c : {Case{4, 4, 64}, Case{2, 16, 64}, Case{4, 8, 128}}) {
    for (const int step : {1, 3, 5, 7, 11, 33}) {
      const double lines = lines_counted(step, c.edge);
      EXPECT_NEAR(c.texel_bytes * minified_sample_texels(step * step, c.texel_bytes, c.line_bytes),
                  lines * c.line_bytes, 1e-9)
          << step << ", " << c.edge;
    }
  }
}

TEST(Estimate, CountsLinesOnlyWhereTheFinestLevelIsMinified) {
  const std::map<int, ReadTexture> map{
      {0, {.name = "map", .bits = 128, .trilinear = false, .bytes = 16e6, .finest_texels = 1e6}}};
  const auto bytes = [&](const std::vector<float>& areas) {
    return estimate(deck(), {{1, work_with(1, 1)}}, 1, map, 8, areas).bytes_from_memory - 8;
  };
  EXPECT_EQ(bytes({}), 1.25 * 16);
  EXPECT_EQ(bytes({1e-7F}), 1.25 * 16);  // a tenth of a texel
  EXPECT_NEAR(bytes({4e-6F}), 4 * 16, 1e-4);
  const double whole_lines = 16 * std::pow(std::sqrt(128.0 / 16) + 1, 2);
  EXPECT_NEAR(bytes({1.0F}), whole_lines, 1e-9);
  EXPECT_NEAR(bytes({1.0F, 4e-6F}), 0.5 * (whole_lines + 4 * 16), 1e-4);
}

TEST(Estimate, ReadsOfSmallTablesCostNoMemory) {
  const std::map<int, ReadTexture> table{{0, {.name = "table", .bits = 128, .trilinear = false, .bytes = 4096}}};
  EXPECT_EQ(estimate(deck(), {{1, work_with(1, 10)}}, 10, table).bytes_from_memory, 8);
}

}  // namespace
}  // namespace footprint
