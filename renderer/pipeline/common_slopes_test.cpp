// common_slopes.glsl against its C++ twin.
#include <gtest/gtest.h>

#include <array>
#include <random>
#include <vector>

#include "renderer/bake/slope_moments.hpp"
#include "renderer/pipeline/shader_source.hpp"
#include "tests/support/shader_probe.hpp"

namespace footprint::testing {
namespace {

// The nearest matrix without negative eigenvalues, in GLSL as in C++; no determinant is below zero by more than
// rounding.
TEST(CommonSlopes, GlslRecoversTheSameCovariance) {
  std::mt19937 random(6);
  std::uniform_real_distribution<float> uniform(-1.0F, 1.0F);
  std::vector<std::array<glm::vec4, 3>> inputs;
  for (int i = 0; i < 500; ++i) {
    const glm::vec2 mean(uniform(random), uniform(random));
    const glm::vec3 noise(uniform(random), uniform(random), uniform(random));
    const float size = i % 2 == 0 ? 0.5F : 0.01F;
    inputs.push_back({glm::vec4(mean, 0, 0),
                      glm::vec4(glm::vec3(mean.x * mean.x, mean.x * mean.y, mean.y * mean.y) + size * noise, 0),
                      glm::vec4(0)});
  }
  ShaderVariant variant;
  const auto out =
      evaluate_glsl("vec4 lobe_cutoff;\n" +
                        shared_functions(shader_flags(variant), {"test.glsl", "#include \"common_slopes.glsl\"\n"}),
                    "mat2 s = slopeCovariance(a.xy, b.xyz); return vec4(s[0], s[1]);", inputs);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const auto& [b, m, unused] = inputs[i];
    const glm::dmat2 expected = covariance({glm::dvec2(b), {m.x, m.y, m.y, m.z}});
    EXPECT_NEAR(out[i].x, expected[0][0], 1e-6);
    EXPECT_NEAR(out[i].y, expected[0][1], 1e-6);
    EXPECT_NEAR(out[i].w, expected[1][1], 1e-6);
    EXPECT_EQ(out[i].y, out[i].z);
    EXPECT_GE(expected[0][0] * expected[1][1] - expected[0][1] * expected[0][1], -1e-15);
  }
}

}  // namespace
}  // namespace footprint::testing
