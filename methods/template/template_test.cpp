// The checks of every method's own test: its formula against a sum that shares no code with it, the limit where
// there is nothing to filter, the case that it is made for, and what it leaves out.
#include <gtest/gtest.h>

#include <cmath>

#include "renderer/image/metrics.hpp"
#include "renderer/pipeline/base_surface.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint {
const Method& template_method();
}

namespace footprint::testing {
namespace {

constexpr BaseBrdf blinn_phong{NormalDistribution::blinn_phong, GeometryTerm::none, FresnelTerm::none, true};

Prefiltered baked(const Material& material) {
  const Options options(template_method().info.options, {}, "template");
  return template_method().precompute(material, options, EffectSet{}.set(), no_progress);
}

double difference(const Image& picture, const Image& reference) {
  return compare_images(picture, reference, 1.0F).value().relative_rmse;
}

// (1 - |mean|) / |mean| of the `edge` x `edge` texels from column x, row y.
double block_spread(const Image& normals, int x, int y, int edge) {
  glm::dvec3 sum(0.0);
  for (int row = y; row < y + edge; ++row) {
    for (int column = x; column < x + edge; ++column) {
      const auto n = normals.at(column, row);
      sum += glm::dvec3(n[0], n[1], n[2]);
    }
  }
  const double length = glm::length(sum) / (edge * edge);
  return (1.0 - length) / length;
}

TEST(Template, SpreadIsThatOfIndependentTexels) {
  const Image normals = random_normals(64, 64, 0.4F, 7);
  const PrefilteredTexture texture = baked(square_scene(normals, {}).materials[0]).textures.at(0);
  for (const int level : {1, 2, 4}) {
    const int edge = 1 << level;
    double sum = 0;
    for (int y = 0; y < 64; y += edge)
      for (int x = 0; x < 64; x += edge) sum += block_spread(normals, x, y, edge);
    const double expected = sum * edge * edge / (64.0 * 64.0);
    const Image stored = decode_level(texture, static_cast<std::size_t>(level));
    EXPECT_NEAR(stored.at(0, 0)[3] / expected, 1.0, 0.05) << "level " << level;
  }
}

TEST(Template, EqualsTheBaseSurfaceOnAConstantMap) {
  Image normals = constant_normals(64, 64, glm::vec3(0.28F, 0.0F, 0.96F));
  normals.at(0, 0)[0] += 2e-5F;  // keeps a flat map from being left out, and is not a visible bump
  TestRenderer renderer(square_scene(normals, {.brdf = blinn_phong}));
  for (const double distance : {0.05, 1.0, 4.0}) {
    const Image reference = renderer.frame(base_surface(), {}, {}, 0, distance);
    EXPECT_LT(difference(renderer.frame(template_method(), {}, {}, 0, distance), reference), 1e-3) << distance;
  }
}

TEST(Template, BeatsTheUnwidenedLobeFarAway) {
  Scene scene = square_scene(random_normals(256, 256, 0.4F, 9),
                             {.brdf = blinn_phong, .base_color = glm::vec3(0.0F), .specular = glm::vec3(0.5F)});
  scene.materials[0].lobe_parameter = 200.0F;
  TestRenderer renderer(scene, {16, 16});
  const Image reference = renderer.reference(1024).mean;
  const double unwidened = difference(renderer.frame(template_method(), "template:share=0"), reference);
  EXPECT_LT(difference(renderer.frame(template_method()), reference), 0.5 * unwidened);
}

// Normals that cancel have no mean: the lobe is then the widest, and the picture stays finite.
TEST(Template, StaysFiniteWhereNormalsCancel) {
  Image pair(2, 1, 4, 1.0F);
  pair.texels = {1, 0, 0, 1, -1, 0, 0, 1};
  TestRenderer renderer(square_scene(pair, {}));
  for (const float value : renderer.frame(template_method(), {}, {}, 0, 20.0).texels)
    ASSERT_TRUE(std::isfinite(value) && value >= 0.0F);
}

TEST(Template, TakesTheMeanRoughnessWhereItVaries) {
  Material material = square_scene({}, {}).materials[0];
  auto stripes = std::make_shared<Image>(2, 1, 2);
  stripes->texels = {0.2F, 0.0F, 0.6F, 0.0F};
  material.metallic_roughness_map = TextureMap{.name = "stripes", .image = stripes, .coordinates = {}};
  EXPECT_NEAR(baked(material).scalars.at("template_lobe"), 0.4F * 0.4F, 1e-6F);
  EXPECT_FALSE(has(template_method().info.honours, Effect::roughness_variation));
}

}  // namespace
}  // namespace footprint::testing
