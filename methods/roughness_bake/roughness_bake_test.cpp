// The module's formulas against presets.cpp, and what the method makes of pictures.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "methods/roughness_bake/presets.hpp"
#include "renderer/core/error.hpp"
#include "renderer/image/metrics.hpp"
#include "renderer/pipeline/shader_source.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/shader_probe.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint {
const Method& naive_mip_method();
const Method& roughness_bake_method();
}  // namespace footprint

namespace footprint::testing {
namespace {

using namespace roughness_bake;

// `widened` of the module, over pairs of alpha^2 and what is stored.
std::vector<glm::vec4> widened_in_glsl(std::string_view preset, NormalDistribution distribution,
                                       std::span<const std::array<glm::vec4, 3>> inputs) {
  (void)shared_context();
  const Options options(roughness_bake_method().info.options, {{"preset", std::string(preset)}}, "roughness_bake");
  ShaderVariant variant;
  variant.brdf.distribution = distribution;
  const std::string text =
      "const float option_bake_constant = 2.0;\nconst float option_bake_cap = 1.0;\nvec4 lobe_cutoff;\n" +
      shared_functions(shader_flags(variant, options), roughness_bake_method().shader);
  return evaluate_glsl(text, "return vec4(widened(a.x, b.x));", inputs);
}

TEST(RoughnessBake, ModuleHasTheFormulasOfThePresets) {
  std::vector<std::array<glm::vec4, 3>> inputs;
  for (const float alpha : {0.02F, 0.1F, 0.35F, 0.7F, 0.75F, 0.95F}) {
    for (const float shortfall : {0.0F, 1e-5F, 1e-3F, 0.02F, 0.2F, 0.6F})
      inputs.push_back({glm::vec4(alpha * alpha), glm::vec4(shortfall), {}});
  }
  for (const NormalDistribution distribution : {NormalDistribution::ggx, NormalDistribution::beckmann,
                                                NormalDistribution::vmf, NormalDistribution::blinn_phong}) {
    for (const std::string_view name : preset_names) {
      const Preset preset = preset_of(name);
      auto stored = inputs;
      for (auto& input : stored) input[1] = glm::vec4(static_cast<float>(stored_spread(preset, input[1].x)));
      const auto got = widened_in_glsl(name, distribution, stored);
      for (std::size_t i = 0; i < stored.size(); ++i) {
        const double expected = widened_alpha2({.preset = preset}, distribution, stored[i][0].x, stored[i][1].x);
        EXPECT_NEAR(got[i].x / expected, 1.0, 2e-4) << name << ", alpha^2 " << stored[i][0].x << ", " << stored[i][1].x;
      }
    }
  }
}

Scene bumpy_scene(NormalDistribution distribution) {
  Scene scene = square_scene(random_normals(256, 256, 0.4F, 9),
                             {.brdf = {distribution, GeometryTerm::none, FresnelTerm::none, true},
                              .base_color = glm::vec3(0.0F),
                              .specular = glm::vec3(0.5F)});
  scene.materials[0].roughness = 0.35F;
  return scene;
}

// Far away: the best constant leaves the least, and a constant of 0 is the naive mip.
TEST(RoughnessBake, TheFitIsClosestToTheReferenceFarAway) {
  for (const NormalDistribution distribution : {NormalDistribution::ggx, NormalDistribution::beckmann}) {
    TestRenderer renderer(bumpy_scene(distribution), {16, 16});
    const Image reference = renderer.reference(1024).mean;
    const auto error = [&](const std::string& text) {
      return compare_images(renderer.frame(roughness_bake_method(), text), reference, 1.0F).value().relative_rmse;
    };
    const double fit = error("roughness_bake");
    EXPECT_LT(fit, 0.5 * error("roughness_bake:preset=free:constant=0"));
    EXPECT_LT(fit, error("roughness_bake:preset=unity"));
    EXPECT_LT(fit, error("roughness_bake:preset=hdrp_import"));
    EXPECT_LT(fit, error("roughness_bake:preset=order1886"));
  }
}

TEST(RoughnessBake, ConstantOfZeroIsTheNaiveMip) {
  TestRenderer renderer(bumpy_scene(NormalDistribution::ggx), {16, 16});
  const Image naive = renderer.frame(naive_mip_method());
  const Image none = renderer.frame(roughness_bake_method(), "roughness_bake:preset=free:constant=0");
  EXPECT_LT(compare_images(none, naive, 1.0F).value().relative_rmse, 1e-6);
}

// The maps of presets differ: each has its own.
TEST(RoughnessBake, EveryPresetDrawsAPictureOfItsOwn) {
  TestRenderer renderer(bumpy_scene(NormalDistribution::ggx), {16, 16});
  std::vector<double> means;
  for (const std::string_view name : preset_names) {
    const Image picture = renderer.frame(roughness_bake_method(), "roughness_bake:preset=" + std::string(name));
    double sum = 0;
    for (const float value : picture.texels) {
      ASSERT_TRUE(std::isfinite(value) && value >= 0.0F) << name;
      sum += std::pow(value, 2.0F);
    }
    means.push_back(sum);
  }
  const auto of = [&](Preset preset) { return means[static_cast<std::size_t>(preset)]; };
  EXPECT_GT(of(Preset::unity), of(Preset::order1886));
  EXPECT_GT(of(Preset::order1886), of(Preset::mjp_vmf));
  EXPECT_EQ(of(Preset::free), of(Preset::mjp_vmf)) << "constant 2, capped at 1";
}

// Grooves seen along them: a lobe with two widths leaves less than the round one.
TEST(RoughnessBake, AnisotropicDrawsGrooves) {
  const Scene scene = receding_grooves();
  TestRenderer renderer(scene, {32, 32});
  const Image reference = renderer.reference(1024).mean;
  const auto error = [&](const std::string& text) {
    return compare_images(renderer.frame(roughness_bake_method(), text), reference, 1.0F).value().relative_rmse;
  };
  const double round = error("roughness_bake"), directed = error("roughness_bake:anisotropic=on");
  EXPECT_LT(directed, 0.8 * round) << directed << " and " << round;
  EXPECT_LT(std::abs(error("roughness_bake:anisotropic=on:storage=unorm8") - directed), 0.1 * directed);
}

// On a map without spread both widths are the roughness.
TEST(RoughnessBake, AnisotropicOfOneTiltIsTheRoundLobe) {
  Scene scene = square_scene(constant_normals(8, 8, glm::normalize(glm::vec3(0.3F, 0.2F, 1.0F))), {});
  TestRenderer renderer(scene, {16, 16});
  const Image round = renderer.frame(roughness_bake_method());
  const Image directed = renderer.frame(roughness_bake_method(), "roughness_bake:anisotropic=on");
  EXPECT_LT(compare_images(directed, round, 1.0F).value().relative_rmse, 1e-3);
}

TEST(RoughnessBake, RefusesAConstantThatIsNotThePresets) {
  const Options options(roughness_bake_method().info.options, {{"preset", "godot"}, {"constant", "1"}}, "x");
  const Material material = bumpy_scene(NormalDistribution::ggx).materials[0];
  EXPECT_THROW((void)roughness_bake_method().precompute(material, options, {}, no_progress), Error);
}

}  // namespace
}  // namespace footprint::testing
