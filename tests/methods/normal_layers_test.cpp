// A detail layer over a normal map: methods that honour the effect agree with the reference, which adds slopes.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "methods/registry.hpp"
#include "renderer/bake/slope_moments.hpp"
#include "renderer/image/metrics.hpp"
#include "tests/support/method_probe.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing {
namespace {

constexpr std::array<const char*, 6> honouring{"naive_mip",   "toksvig", "roughness_bake",
                                               "specular_aa", "lean",    "leadr"};

TextureMap tiled(const Image& normals, float tiles) {
  TextureMap map{"layer", std::make_shared<const Image>(normals), {}};
  map.coordinates.transform = glm::mat3x2{tiles, 0.0F, 0.0F, tiles, 0.0F, 0.0F};
  return map;
}

Scene layered_scene(const Image& normals, const Image& layer, float tiles, const SquareMaterial& material = {}) {
  Scene scene = square_scene(normals, material);
  scene.materials[0].layer_map = tiled(layer, tiles);
  return scene;
}

// One map with the slopes of `normals` and of `layer`, which repeats.
Image summed(const Image& normals, const Image& layer) {
  Image out(normals.width, normals.height, 4, 1.0F);
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      const auto slope = [](std::span<const float> n) { return glm::dvec2(n[0], n[1]) / static_cast<double>(n[2]); };
      const glm::dvec2 sum = slope(normals.at(x, y)) + slope(layer.at(x % layer.width, y % layer.height));
      const glm::vec3 n(glm::normalize(glm::dvec3(sum, 1.0)));
      std::copy_n(&n.x, 3, out.at(x, y).begin());
    }
  }
  return out;
}

double relative_difference(const Image& picture, const Image& reference) {
  return compare_images(picture, reference, 1.0F).value().relative_rmse;
}

TEST(NormalLayers, TheReferenceAddsSlopesTexelByTexel) {
  const Image normals = random_normals(32, 32, 0.5F, 1);
  for (const auto& [layer, tiles] :
       {std::pair{random_normals(32, 32, 0.4F, 2), 1.0F}, std::pair{random_normals(8, 8, 0.4F, 3), 4.0F}}) {
    const Image two = TestRenderer(layered_scene(normals, layer, tiles)).reference(16).mean;
    const Image one = TestRenderer(square_scene(summed(normals, layer), {})).reference(16).mean;
    EXPECT_LT(relative_difference(two, one), 1e-4) << tiles;
  }
}

TEST(NormalLayers, ALayerNeedsNoNormalMapBelowIt) {
  const Image layer = random_normals(16, 16, 0.4F, 4);
  const Image two = TestRenderer(layered_scene({}, layer, 1.0F)).reference(16).mean;
  EXPECT_LT(relative_difference(two, TestRenderer(square_scene(layer, {})).reference(16).mean), 1e-5);
}

// One texel per pixel, read at its centre.
TEST(NormalLayers, MethodsEqualDirectWhereNothingIsFiltered) {
  const BaseBrdf brdf{NormalDistribution::blinn_phong, GeometryTerm::none, FresnelTerm::schlick, true};
  const Scene scene =
      layered_scene(random_normals(64, 64, 0.4F, 5), random_normals(64, 64, 0.3F, 6), 1.0F, {.brdf = brdf});
  TestRenderer renderer(scene);
  const Image direct = renderer.frame(find_method("direct"));
  for (const char* const name : honouring)
    EXPECT_LT(relative_difference(renderer.frame(find_method(name)), direct), 2e-3) << name;
  EXPECT_LT(relative_difference(renderer.frame(find_method("lean"), "lean:variant=clean"), direct), 2e-3);
}

// Constant maps: at any distance, and by every base BRDF's own terms.
TEST(NormalLayers, MethodsEqualDirectOnConstantMaps) {
  const Scene scene =
      layered_scene(constant_normals(16, 16, {0.28F, 0.0F, 0.96F}), constant_normals(4, 4, {0.0F, 0.28F, 0.96F}), 3.0F);
  TestRenderer renderer(scene);
  for (const double distance : {0.05, 1.0, 4.0}) {
    const Image direct = renderer.frame(find_method("direct"), {}, {}, 0, distance);
    for (const char* const name : honouring) {
      const Image picture = renderer.frame(find_method(name), {}, {}, 0, distance);
      EXPECT_LT(relative_difference(picture, direct), 1e-3) << name << " " << distance;
    }
  }
}

// The shader's mean and covariance against the moments of both maps, combined as in the paper.
TEST(NormalLayers, MomentsCombineAsInThePaper) {
  Material material = square_scene(random_normals(16, 16, 0.5F, 7), {}).materials[0];
  material.layer_map = tiled(random_normals(8, 8, 0.6F, 8), 1.0F);
  const auto moments = [](const TextureMap& map) {
    const Image top = slope_moment_chain(map.image.decoded(), Image(1, 1, 1, 0.0F)).back();
    const std::vector<float>& t = top.texels;
    return SlopeMoments{{t[slope_x], t[slope_y]}, {t[slope_xx], t[slope_xy], t[slope_xy], t[slope_yy]}};
  };
  const SlopeMoments both = layered(moments(*material.normal_map), moments(*material.layer_map));
  const glm::dmat2 spread = covariance(both);
  for (const char* const name : {"lean", "leadr"}) {
    ProbedMethod probed{&find_method(name), &material};
    probed.effects.set(static_cast<std::size_t>(Effect::normal_layers));
    const std::array<std::array<glm::vec4, 3>, 1> input{};
    const glm::vec4 mean = probe_method(probed, "return vec4(e.lobe.mean, 0.0, 0.0);", input)[0];
    const glm::vec4 c = probe_method(probed, "return vec4(e.lobe.spread[0], e.lobe.spread[1]);", input)[0];
    for (int i = 0; i < 2; ++i) EXPECT_NEAR(mean[i], both.mean[i], 1e-6) << name;
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(c[i], spread[i / 2][i % 2], 1e-6) << name;
  }
}

// Independent layers under pixels that cover many of their texels.
TEST(NormalLayers, FollowTheReferenceFarAway) {
  const BaseBrdf brdf{NormalDistribution::blinn_phong, GeometryTerm::none, FresnelTerm::none, true};
  Scene scene = layered_scene(gaussian_slope_normals(512, 0.2F), gaussian_slope_normals(128, 0.25F), 5.0F,
                              {.brdf = brdf, .specular = glm::vec3(0.5F)});
  scene.materials[0].lobe_parameter = 50.0F;
  TestRenderer renderer(scene, {16, 16});
  const Image reference = renderer.reference(1024).mean;
  const auto error = [&](const char* name) {
    return relative_difference(renderer.frame(find_method(name)), reference);
  };
  Scene bare = scene;
  bare.materials[0].layer_map.reset();
  for (const char* const name : {"lean", "leadr"}) {
    EXPECT_LT(error(name), 0.1) << name;
    const Image without = TestRenderer(bare, {16, 16}).frame(find_method(name));
    EXPECT_GT(relative_difference(without, reference), 3.0 * error(name)) << name;
  }
  EXPECT_LT(error("toksvig"), error("naive_mip"));
}

// A method that cannot honour a layer draws the material without it, and says so.
TEST(NormalLayers, AreLeftOutByTheOthers) {
  const Scene scene = layered_scene(random_normals(16, 16, 0.4F, 9), random_normals(16, 16, 0.4F, 10), 1.0F);
  Scene bare = scene;
  bare.materials[0].layer_map.reset();
  TestRenderer with(scene, {16, 16});
  TestRenderer without(bare, {16, 16});
  for (const Method* method : all_methods()) {
    const double difference = largest_difference(with.frame(*method), without.frame(*method));
    if (has(method->info.honours, Effect::normal_layers)) {
      EXPECT_GT(difference, 1e-2) << method->info.name;
    } else {
      EXPECT_EQ(difference, 0.0) << method->info.name;
    }
  }
}

// An invalid texel of the layer has no radiance, as one of the normal map has none.
TEST(NormalLayers, InvalidTexelsDoNotCount) {
  Image layer = constant_normals(8, 8, {0.28F, 0.0F, 0.96F});
  for (int i = 0; i < 4; ++i) std::ranges::fill(layer.at(i, 3), 0.0F);
  const Image normals = random_normals(8, 8, 0.3F, 11);
  TestRenderer renderer(layered_scene(normals, layer, 1.0F), {16, 16});
  for (const Method* method : all_methods()) {
    for (const float value : renderer.frame(*method).texels) ASSERT_TRUE(std::isfinite(value)) << method->info.name;
  }
  for (const float value : renderer.reference(16).mean.texels) ASSERT_TRUE(std::isfinite(value));
}

}  // namespace
}  // namespace footprint::testing
