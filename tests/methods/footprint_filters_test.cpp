// The footprint filters under every method: parts of one are the whole, parts converge to the reference, what is linear
// may be averaged before or after it is shaded, and what is counted is what is looked up.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <string>

#include "methods/registry.hpp"
#include "renderer/pipeline/frame.hpp"
#include "tests/methods/method_number.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/shadow_scenes.hpp"
#include "tests/support/sweep.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing {
namespace {

Scene receding_square(int side) {
  Scene scene = square_scene(random_normals(side, side, 0.6F, 5), {.brdf = {}, .roughness = 0.4F});
  scene.camera = receding_grooves().camera;
  return scene;
}

bool has_hardware_filter() { return shared_context().info().max_anisotropy >= 8; }

class FootprintFilters : public ::testing::TestWithParam<const Method*> {
 protected:
  /// `count` of `filters` for the method by default, others for the next method.
  template <std::size_t N>
  static std::vector<const char*> some(const std::array<const char*, N>& filters, std::size_t count) {
    return sweep(filters, count, count * method_number(*GetParam()));
  }
};

TEST_P(FootprintFilters, OnePartIsTheWhole) {
  const int side = map_side(*GetParam(), 64);
  TestRenderer& renderer =
      shared_renderer("receding " + std::to_string(side), [side] { return receding_square(side); }, {24, 24});
  const Image whole = renderer.frame(*GetParam(), {}, filter_of("trilinear"));
  for (const char* const text : some(std::array{"shaded:1", "box:1", "anisotropic:1"}, 1))
    EXPECT_LT(largest_difference(renderer.frame(*GetParam(), {}, filter_of(text)), whole), 1e-4) << text;
}

// For every method: a pixel of 8 x 8 texels in as many parts has nothing left to prefilter.
TEST_P(FootprintFilters, PartsConvergeToTheReference) {
  if (!GetParam()->info.resolves_texels) GTEST_SKIP() << "has one BRDF for the whole map";
  const int side = map_side(*GetParam(), 128, 64);
  const auto scene = [side] {
    return square_scene(random_normals(side, side, 0.5F, 7), {.brdf = {}, .roughness = 0.5F});
  };
  TestRenderer& renderer =
      shared_renderer("8 x 8 texels per pixel " + std::to_string(side), scene, {side / 8, side / 8});
  static std::map<int, Image> references;  // the same for all methods with maps of one size
  if (!references.contains(side)) references[side] = renderer.reference(1024, 1, Sampling::nearest).mean;
  const Image& reference = references[side];
  const double few = error_of(renderer.frame(*GetParam(), {}, filter_of("shaded:2")), reference);
  const double all = error_of(renderer.frame(*GetParam(), {}, filter_of("shaded:8")), reference);
  constexpr double noise = 0.005;  // of the reference
  EXPECT_LT(all, std::max(0.6 * few, noise));
  EXPECT_LT(all, 0.05);
}

TEST_P(FootprintFilters, HaveNothingToDoWhereNothingVaries) {
  const auto scene = [] {
    Image normals = constant_normals(32, 32, {0.28F, 0, 0.96F});
    normals.at(0, 0)[0] += 2e-5F;  // keeps a flat map from being left out, and is not a visible bump
    return square_scene(normals, {});
  };
  TestRenderer& renderer = shared_renderer("nothing varies", scene);
  const Image direct = renderer.frame(find_method("direct"));
  for (const char* const text :
       some(std::array{"trilinear", "anisotropic:8", "box:3", "area:3", "ewa:8", "shaded:3"}, 3))
    EXPECT_LT(error_of(renderer.frame(*GetParam(), {}, filter_of(text)), direct), 1e-3) << text;
  if (!has_hardware_filter() || (!all_tests() && method_number(*GetParam()) % 2 != 0)) return;
  EXPECT_LT(error_of(renderer.frame(*GetParam(), {}, filter_of("hardware:8")), direct), 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Registry, FootprintFilters, ::testing::ValuesIn(all_methods().begin(), all_methods().end()),
                         [](const auto& tested) { return tested.param->info.name; });

// The sampler of a filter does not change lookups at a level of the module's own choice: direct's finest, and the
// parts of the hemisphere that a walk of Xu's method visits. Hardware gets the footprint from coordinates and picks
// its own.
TEST(FootprintFilter, LevelsThatAModuleNamesAreTheSameUnderEach) {
  TestRenderer& renderer = shared_renderer("receding 64", [] { return receding_square(64); }, {24, 24});
  const Image finest = renderer.frame(find_method("direct"), {}, filter_of("trilinear"));
  for (const char* const text : {"anisotropic:8", "box:3", "area:3", "ewa:8"})
    EXPECT_LT(largest_difference(renderer.frame(find_method("direct"), {}, filter_of(text)), finest), 1e-5) << text;
  if (!has_hardware_filter()) return;
  EXPECT_LT(largest_difference(renderer.frame(find_method("direct"), {}, filter_of("hardware:8")), finest), 1e-5);
  const Image probed = renderer.frame(find_method("xu_vmf"), {}, filter_of("anisotropic:8"));
  EXPECT_LT(largest_difference(renderer.frame(find_method("xu_vmf"), {}, filter_of("hardware:8")), probed), 1e-4);
}

// Lights that are found once per pixel are those that are found for each part: of each kind, with shadows.
TEST(FootprintFilter, PartsSeeEveryLight) {
  Scene scene = box_over_floor();
  const PointLight point{{0.6F, 0.5F, 1.5F}, glm::vec3(5.0F), {}};
  SpotLight spot{{{-0.7F, 0.2F, 1.4F}, glm::vec3(5.0F), {}}};
  spot.outer_cone_angle = 0.9F;
  const DirectionalLight directional{glm::normalize(glm::vec3(0.3F, 0.2F, -1.0F)), glm::vec3(1.0F)};
  scene.lights = {point, spot, directional, point};
  TestRenderer renderer(scene, {48, 48});
  const Image whole = renderer.frame(find_method("direct"), {}, filter_of("trilinear"));
  EXPECT_LT(largest_difference(renderer.frame(find_method("direct"), {}, filter_of("shaded:2")), whole), 1e-5);
  scene.lights.pop_back();
  EXPECT_GT(largest_difference(TestRenderer(scene, {48, 48}).frame(find_method("direct")), whole), 1e-2)
      << "a light less is seen";
}

// Colour under Lambert's term is linear: its mean may be shaded, or what is shaded averaged.
TEST(FootprintFilter, ColoursAreLinear) {
  Scene scene = square_scene({}, {.brdf = {NormalDistribution::ggx, GeometryTerm::none, FresnelTerm::none, true},
                                  .specular = glm::vec3(0.0F)});
  auto colours = std::make_shared<Image>(64, 64, 4, 1.0F);
  for (std::size_t i = 0; i < colours->texel_count(); ++i) colours->texels[4 * i] = (i * 7919) % 13 < 5 ? 1.0F : 0.1F;
  scene.materials[0].base_color_map = TextureMap{"colours", colours, {}};
  TestRenderer renderer(scene, {20, 20});
  const Image averaged = renderer.frame(find_method("direct"), {}, filter_of("box:3"));
  EXPECT_LT(largest_difference(renderer.frame(find_method("direct"), {}, filter_of("shaded:3")), averaged), 1e-4);
  EXPECT_GT(largest_difference(renderer.frame(find_method("direct"), {}, filter_of("trilinear")), averaged), 1e-3);
}

// A sum over texels is linear in the kernel: of a box's probes, or of as many parts, it is the same.
TEST(FootprintFilter, TheExactSumIsThatOfItsParts) {
  TestRenderer renderer(receding_square(64), {16, 16});
  const Image probes = renderer.frame(find_method("exact"), {}, filter_of("box:3"));
  EXPECT_LT(error_of(renderer.frame(find_method("exact"), {}, filter_of("shaded:3")), probes), 0.001);
  EXPECT_GT(error_of(renderer.frame(find_method("exact"), {}, filter_of("shaded:2")), probes), 0.004);
}

// Parts share the texels that a pixel may look at: none is left out where a loop would end.
TEST(FootprintFilter, TheExactSumOfManyTexelsIsWhole) {
  Scene scene = square_scene(random_normals(512, 512, 0.6F, 5), {.brdf = {}, .roughness = 0.4F});
  scene.lights.resize(4, scene.lights.front());
  TestRenderer renderer(scene, {2, 2});
  for (const char* const text : {"shaded:2", "shaded:4"}) {
    for (const float value : renderer.frame(find_method("exact"), {}, filter_of(text)).texels)
      ASSERT_TRUE(std::isfinite(value)) << text;
  }
}

// One light, a normal map, no other map: what each formula takes by its definition.
TEST(FootprintFilter, LookupsAndLobesAreCounted) {
  TestRenderer renderer(square_scene(random_normals(64, 64, 0.5F, 7), {.brdf = {}, .roughness = 0.5F}), {16, 16});
  const auto expect_work = [&](const char* method, const char* filter, double lookups, double lobes) {
    const MethodSpec spec = parse_methods(method).front();
    const PixelWork work = renderer.work(find_method(spec.name), method, filter_of(filter));
    EXPECT_NEAR(work.lookups, lookups, 1e-6) << method << " " << filter;
    EXPECT_NEAR(work.lobes, lobes, 1e-6) << method << " " << filter;
  };
  expect_work("naive_mip", "trilinear", 1, 1);
  expect_work("naive_mip", "anisotropic:8", 1, 1);  // the footprint is even
  expect_work("naive_mip", "box:3", 9, 1);
  expect_work("naive_mip", "area:3", 9, 1);
  expect_work("naive_mip", "shaded:3", 9, 9);
  if (shared_context().info().max_anisotropy >= 4) expect_work("naive_mip", "hardware:4", 1, 1);
  expect_work("lean", "box:2", 8, 1);    // two textures
  expect_work("direct", "box:3", 1, 1);  // reads the finest level alone
}

}  // namespace
}  // namespace footprint::testing
