// Properties of every method of the registry: it equals `direct` where nothing needs filtering, is deterministic, has
// finite values, and describes itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "methods/registry.hpp"
#include "renderer/image/metrics.hpp"
#include "tests/methods/method_number.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/sweep.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing {
namespace {

constexpr std::array<BaseBrdf, 4> brdfs = {{
    {NormalDistribution::ggx, GeometryTerm::smith, FresnelTerm::schlick, true},
    {NormalDistribution::beckmann, GeometryTerm::smith, FresnelTerm::schlick, true},
    {NormalDistribution::blinn_phong, GeometryTerm::none, FresnelTerm::none, true},
    {NormalDistribution::vmf, GeometryTerm::tan, FresnelTerm::schlick, true},
}};

// The part of a shared renderer's key that depends on the base BRDF.
std::string brdf_key(const BaseBrdf& brdf) { return std::to_string(static_cast<int>(brdf.distribution)); }

class EveryMethod : public ::testing::TestWithParam<const Method*> {
 protected:
  /// Base BRDFs for the method: `count` of the four by default, others for the next method.
  static std::vector<BaseBrdf> some_brdfs(std::size_t count) { return sweep(brdfs, count, method_number(*GetParam())); }

  static double difference_from_direct(TestRenderer& renderer, double distance) {
    const Image direct = renderer.frame(find_method("direct"), {}, {}, 0, distance);
    const Image picture = renderer.frame(*GetParam(), {}, {}, 0, distance);
    return compare_images(picture, direct, 1.0F).value().relative_rmse;
  }
};

// A tilted constant map cannot be left out as flat: it goes through the whole precompute.
TEST_P(EveryMethod, EqualsDirectOnAConstantMapAtAnyDistance) {
  for (const BaseBrdf& brdf : some_brdfs(2)) {
    for (const glm::vec3& normal : {glm::vec3(0, 0, 1), glm::vec3(0.28F, 0, 0.96F)}) {
      const auto scene = [&] {
        Image normals = constant_normals(64, 64, normal);
        normals.at(0, 0)[0] += 2e-5F;  // keeps a flat map from being left out, and is not a visible bump
        return square_scene(normals, {.brdf = brdf});
      };
      TestRenderer& renderer = shared_renderer((normal.x > 0.0F ? "tilted " : "flat ") + brdf_key(brdf), scene);
      for (const double distance : {0.05, 1.0, 4.0}) {
        EXPECT_LT(difference_from_direct(renderer, distance), 1e-3)
            << "distribution " << static_cast<int>(brdf.distribution) << ", distance " << distance;
      }
    }
  }
}

// A rectangle of light is reflected as by `direct`: by points exactly, by lobes but for the fit of lobes without a
// tail, which some methods have for GGX.
TEST_P(EveryMethod, LightsAreasAsDirectOnAConstantMap) {
  for (const AreaIntegral integral : {AreaIntegral::points, AreaIntegral::lobes}) {
    const auto scene = [&] {
      Scene tilted = square_scene(constant_normals(8, 8, {0.28F, 0, 0.96F}), {.brdf = brdfs[0]});
      tilted.lights = {AreaLight{.position = {0.4F, 0.3F, 1.5F}, .integral = integral}};
      return tilted;
    };
    const bool by_points = integral == AreaIntegral::points;
    TestRenderer& renderer = shared_renderer(by_points ? "area by points" : "area by lobes", scene);
    EXPECT_LT(difference_from_direct(renderer, 2.0), by_points ? 1e-3 : 0.1);
  }
}

// Facets that lean 53 degrees under a light 10 degrees below the surface's plane: with an open horizon every method
// shows what `direct` shows there, and with a cut one nothing.
TEST_P(EveryMethod, KnowsLightFromBelowTheHorizonByTheScenesRule) {
  for (const BaseBrdf& brdf : some_brdfs(1)) {
    const auto scene = [&](Horizon horizon) {
      Image normals = constant_normals(64, 64, {0.8F, 0, 0.6F});
      normals.at(0, 0)[0] += 2e-5F;  // as above
      Scene lit = square_scene(normals, {.brdf = brdf});
      lit.lights = {DirectionalLight{.direction = {-0.985F, 0.0F, 0.174F}, .illuminance = glm::vec3(3.0F)}};
      lit.horizon = horizon;
      return lit;
    };
    TestRenderer& cut = shared_renderer("cut " + brdf_key(brdf), [&] { return scene(Horizon::cut); });
    EXPECT_EQ(covered_mean(cut.frame(*GetParam())), 0.0);
    TestRenderer& renderer = shared_renderer("open " + brdf_key(brdf), [&] { return scene(Horizon::open); });
    EXPECT_GT(covered_mean(renderer.frame(find_method("direct"))), 0.05);
    for (const double distance : {0.05, 1.0, 4.0}) {
      EXPECT_LT(difference_from_direct(renderer, distance), 1e-3)
          << "distribution " << static_cast<int>(brdf.distribution) << ", distance " << distance;
    }
  }
}

// Near a map that is flat where the camera looks.
TEST_P(EveryMethod, EqualsDirectAtMagnificationWhereTheMapIsFlat) {
  if (!GetParam()->info.resolves_texels) GTEST_SKIP() << "has one BRDF for the whole map";
  const int side = map_side(*GetParam(), 64);
  Image normals = random_normals(side, side, 0.5F, 2);
  for (int y = 3 * side / 8; y < 5 * side / 8; ++y) {
    for (int x = 3 * side / 8; x < 5 * side / 8; ++x) {
      const glm::vec3 up(0, 0, 1);
      std::copy_n(&up.x, 3, normals.at(x, y).begin());
    }
  }
  TestRenderer renderer(square_scene(normals, {}));
  EXPECT_LT(difference_from_direct(renderer, 0.05), 1e-3);
}

TEST_P(EveryMethod, StaysFiniteAtTheLimits) {
  for (const BaseBrdf& brdf : some_brdfs(2)) {
    for (const float roughness : {0.0F, 1.0F}) {
      for (const float tilt : {0.0F, 0.999F}) {
        const Image normals = random_normals(map_side(*GetParam(), 33), map_side(*GetParam(), 17), tilt, 3);
        TestRenderer renderer(square_scene(normals, {.brdf = brdf, .roughness = roughness}));
        for (const double distance : {0.05, 1.0, 20.0}) {
          for (const float value : renderer.frame(*GetParam(), {}, {}, 0, distance).texels) {
            ASSERT_TRUE(std::isfinite(value) && value >= 0.0F);
          }
        }
      }
    }
  }
}

// What four pixels show, whose differences are a footprint, is their own: neighbours that look other levels up, or have
// more lobes, change nothing.
TEST_P(EveryMethod, IsTheSameFourPixelsByFourPixels) {
  const int side = map_side(*GetParam(), 64);
  Scene scene = square_scene(random_normals(side, side, 0.6F, 5), {.brdf = brdfs[2], .roughness = 0.4F});
  scene.camera = receding_grooves().camera;
  TestRenderer renderer(scene, {24, 24});
  for (const char* const text :
       sweep(std::array{"trilinear", "anisotropic:4", "shaded:2"}, 2, method_number(*GetParam()))) {
    const FootprintFilter filter = parse_footprint_filter(text, "");
    const Image whole = renderer.frame(*GetParam(), {}, filter);
    EXPECT_LT(largest_difference(renderer.frame(*GetParam(), {}, filter, 2), whole), 1e-4) << text;
  }
}

TEST_P(EveryMethod, IsDeterministic) {
  const Scene scene = square_scene(random_normals(map_side(*GetParam(), 64), map_side(*GetParam(), 48), 0.5F, 4), {});
  EXPECT_EQ(TestRenderer(scene).frame(*GetParam()), TestRenderer(scene).frame(*GetParam()));
  const EffectSet set = effects_on(derive_effects(scene));
  const Options options(GetParam()->info.options, {}, "test");
  EXPECT_EQ(GetParam()->precompute(scene.materials[0], options, set, no_progress),
            GetParam()->precompute(scene.materials[0], options, set, no_progress));
}

// Over all pixels and colours.
double mean_of_colours(const Image& picture) {
  double sum = 0.0;
  for (std::size_t i = 0; i < picture.texels.size(); ++i) sum += i % 4 < 3 ? picture.texels[i] : 0.0F;
  return sum / static_cast<double>(3 * picture.texel_count());
}

// At its finest level a method shades texels: it is then the base BRDF, except for what its representation cannot
// store. One that knows no texels has at least their mean.
TEST_P(EveryMethod, RepresentsTheBaseBrdfAtItsFinestLevel) {
  const int side = map_side(*GetParam(), 64);
  TestRenderer& renderer = shared_renderer("random " + std::to_string(side),
                                           [side] { return square_scene(random_normals(side, side, 0.5F, 5), {}); });
  static std::map<int, Image> references;  // the same for all methods with maps of one size
  if (!references.contains(side)) references[side] = renderer.reference(64).mean;
  const Image& reference = references[side];
  const Image finest = renderer.supersampled(*GetParam(), 64).mean;
  if (GetParam()->info.resolves_texels) {
    EXPECT_LT(compare_images(finest, reference, 1.0F).value().relative_rmse, 0.05);
  } else {
    EXPECT_NEAR(mean_of_colours(finest) / mean_of_colours(reference), 1.0, 0.05);
  }
}

TEST_P(EveryMethod, TakesAnisotropicProbes) {
  const int side = map_side(*GetParam(), 64);
  TestRenderer renderer(square_scene(random_normals(side, side, 0.5F, 6), {}));
  const Image isotropic = renderer.frame(*GetParam(), {}, {FootprintFilterKind::trilinear, 1});
  const Image probed = renderer.frame(*GetParam(), {}, {FootprintFilterKind::anisotropic, 8});
  EXPECT_LT(compare_images(probed, isotropic, 1.0F).value().relative_rmse, 0.5);
  for (const float value : probed.texels) ASSERT_TRUE(std::isfinite(value));
}

// Half of the square is lit. The other half is as if there were no light, to the last bit, and its map's mean.
TEST_P(EveryMethod, DrawsUnlitSurfacesInTheirColour) {
  const int side = map_side(*GetParam(), 16);
  Scene scene = square_scene(random_normals(side, side, 0.5F, 6), {.brdf = {}, .base_color = {0.75F, 0.5F, 0.25F}});
  scene.materials.push_back(scene.materials[0]);
  scene.materials[0].unlit = true;
  scene.meshes.push_back(scene.meshes[0]);
  scene.meshes[1].material = 1;
  for (Vertex& vertex : scene.meshes[1].vertices) {
    vertex.position.x = 0.5F * vertex.position.x + 0.5F;
    vertex.position.z = 0.01F;
  }
  const Image picture = TestRenderer(scene, {16, 16}).frame(*GetParam());
  for (const auto& [channel, wanted] : {std::pair{0, 0.75F}, {1, 0.5F}, {2, 0.25F}})
    EXPECT_EQ(picture.at(3, 8)[static_cast<std::size_t>(channel)], wanted);
  EXPECT_NE(picture.at(13, 8)[0], 0.75F);
}

// The same light is added to every method's image.
TEST_P(EveryMethod, AddsEmittedLight) {
  const int side = map_side(*GetParam(), 16);
  Scene scene = square_scene(random_normals(side, side, 0.5F, 6), {});
  const Image dark = TestRenderer(scene, {16, 16}).frame(*GetParam());
  scene.materials[0].emission = {0.75F, 0.5F, 0.25F};
  const Image lit = TestRenderer(scene, {16, 16}).frame(*GetParam());
  for (std::size_t i = 0; i < lit.texel_count(); ++i)
    for (int c = 0; c < 3; ++c)
      ASSERT_NEAR(lit.texels[4 * i + static_cast<std::size_t>(c)] - dark.texels[4 * i + static_cast<std::size_t>(c)],
                  scene.materials[0].emission[c], 1e-5F * (1.0F + dark.texels[4 * i + static_cast<std::size_t>(c)]));
}

TEST_P(EveryMethod, DescribesItself) {
  const MethodInfo& info = GetParam()->info;
  EXPECT_EQ(&find_method(info.name), GetParam());
  EXPECT_TRUE(info.summary.ends_with('.')) << info.summary;
  for (const OptionSpec& option : info.options) EXPECT_FALSE(option.meaning.empty()) << option.name;
  EXPECT_NO_THROW(Options(info.options, {}, info.name));
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryMethod, ::testing::ValuesIn(all_methods().begin(), all_methods().end()),
                         [](const auto& test) { return test.param->info.name; });

}  // namespace
}  // namespace footprint::testing
