// Every method under an environment: it equals `direct` where nothing needs filtering, and has finite values. The
// reference's integral over the environment.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "methods/registry.hpp"
#include "renderer/image/metrics.hpp"
#include "renderer/scene/environment.hpp"
#include "tests/methods/method_number.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/sweep.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing {
namespace {

using std::numbers::pi;

Scene lit_square(const Image& normals, const SquareMaterial& material, Environment environment) {
  Scene scene = square_scene(normals, material);
  scene.lights.clear();
  scene.environment = std::move(environment);
  return scene;
}

// Bright above and on one side, dark below: nothing in it is symmetric.
Environment uneven_environment() {
  Image map(32, 16, 3);
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const auto height = static_cast<float>(1.0 - (y + 0.5) / map.height);
      map.at(x, y)[0] = 0.1F + height * height;
      map.at(x, y)[1] = 0.1F + height * (x < 12 ? 1.0F : 0.2F);
      map.at(x, y)[2] = x == 20 && y == 4 ? 20.0F : 0.3F;
    }
  }
  return {.name = "uneven", .radiance = std::make_shared<const Image>(std::move(map)), .rotation = 0.7F};
}

// One normal everywhere, but for a texel that keeps a flat map from being left out, and is not a visible bump.
Image tilted_normals() {
  Image normals = constant_normals(16, 16, {0.28F, 0, 0.96F});
  normals.at(0, 0)[0] += 2e-5F;
  return normals;
}

constexpr BaseBrdf lambert{NormalDistribution::ggx, GeometryTerm::none, FresnelTerm::none, true};

// All methods share the renderers and the images of the reference.
class UnderAnEnvironment : public ::testing::TestWithParam<const Method*> {
 protected:
  void SetUp() override {
    if (!has(GetParam()->info.honours, Effect::environment_light)) GTEST_SKIP() << "leaves environment light out";
  }
  /// `count` of `distributions` for the method by default, others for the next method.
  template <std::size_t N>
  static std::vector<NormalDistribution> some(const std::array<NormalDistribution, N>& distributions,
                                              std::size_t count) {
    return sweep(distributions, count, count * method_number(*GetParam()));
  }
};

std::string key_of(NormalDistribution distribution) { return std::to_string(static_cast<int>(distribution)); }

TEST_P(UnderAnEnvironment, EqualsDirectOnAConstantMapAtAnyDistance) {
  for (const NormalDistribution distribution :
       some(std::array{NormalDistribution::ggx, NormalDistribution::beckmann, NormalDistribution::blinn_phong,
                       NormalDistribution::vmf},
            2)) {
    const BaseBrdf brdf{distribution, GeometryTerm::smith, FresnelTerm::schlick, true};
    TestRenderer& renderer =
        shared_renderer("tilted " + key_of(distribution),
                        [&] { return lit_square(tilted_normals(), {.brdf = brdf}, uneven_environment()); }, {32, 32});
    for (const double distance : {0.05, 1.0, 4.0}) {
      const Image direct = renderer.frame(find_method("direct"), {}, {}, 0, distance);
      const Image picture = renderer.frame(*GetParam(), {}, {}, 0, distance);
      EXPECT_LT(compare_images(picture, direct, 1.0F).value().relative_rmse, 2e-3)
          << "distribution " << static_cast<int>(distribution) << ", distance " << distance;
    }
  }
}

// A method that shades every light of the environment without maps equals the reference on a constant map. The lookup
// by lobes has the error of its tables.
TEST_P(UnderAnEnvironment, AllOfItsLightsMeetTheReferenceOnAConstantMap) {
  const BaseBrdf brdf{NormalDistribution::ggx, GeometryTerm::smith, FresnelTerm::schlick, true};
  const auto scene = [&] {
    return lit_square(tilted_normals(), {.brdf = brdf, .roughness = 0.6F}, uneven_environment());
  };
  TestRenderer& renderer = shared_renderer("all lights", scene, {6, 6});
  static const Image reference = renderer.reference(64, 1, Sampling::after_shading, 0, EnvironmentUse::dense).mean;
  const Image picture = renderer.frame(*GetParam(), {}, {}, 0, 1.0, EnvironmentUse::dense);
  if (std::ranges::none_of(picture.texels, [](float value) { return std::isfinite(value) && value != 1.0F; }))
    GTEST_SKIP() << "takes more rounds of loops than the software renderer has";
  EXPECT_LT(compare_images(picture, reference, 1.0F).value().relative_rmse, 4e-3);
  EXPECT_GT(compare_images(renderer.frame(*GetParam()), reference, 1.0F).value().relative_rmse, 4e-3) << "the lookup";
}

// Four pixels, whose differences are a footprint, do not depend on neighbours that read other levels or have more
// lobes.
TEST_P(UnderAnEnvironment, IsTheSameFourPixelsByFourPixels) {
  const BaseBrdf brdf{NormalDistribution::ggx, GeometryTerm::smith, FresnelTerm::schlick, false};
  const int side = map_side(*GetParam(), 64);
  const auto scene = [&] {
    Scene receding =
        lit_square(random_normals(side, side, 0.6F, 5), {.brdf = brdf, .roughness = 0.3F}, uneven_environment());
    receding.camera = receding_grooves().camera;
    return receding;
  };
  TestRenderer& renderer = shared_renderer("receding " + std::to_string(side), scene, {24, 24});
  EXPECT_LT(largest_difference(renderer.frame(*GetParam(), {}, {}, 2), renderer.frame(*GetParam())), 1e-4);
}

TEST_P(UnderAnEnvironment, StaysFiniteAtTheLimits) {
  for (const NormalDistribution distribution :
       some(std::array{NormalDistribution::ggx, NormalDistribution::blinn_phong}, 1)) {
    for (const float roughness : {0.0F, 1.0F}) {
      const BaseBrdf brdf{distribution, GeometryTerm::tan, FresnelTerm::schlick, true};
      const auto scene = [&] {
        Scene receding =
            lit_square(random_normals(9, 5, 0.999F, 3), {.brdf = brdf, .roughness = roughness}, uneven_environment());
        receding.camera = receding_grooves().camera;
        return receding;
      };
      TestRenderer& renderer =
          shared_renderer((roughness > 0.0F ? "rough " : "mirror ") + key_of(distribution), scene, {32, 32});
      for (const double distance : {0.05, 4.0}) {
        const Image picture = renderer.frame(*GetParam(), {}, {}, 0, distance);
        for (const float value : picture.texels) ASSERT_TRUE(std::isfinite(value) && value >= 0.0F);
      }
    }
  }
}

// One texel per pixel, where each pixel is close to its own lobe.
TEST_P(UnderAnEnvironment, IsNearTheReference) {
  const auto scene = [] {
    return lit_square(random_normals(16, 16, 0.4F, 5), {.brdf = {}, .roughness = 0.5F}, uneven_environment());
  };
  TestRenderer& renderer = shared_renderer("texel per pixel", scene, {32, 32});
  static const Image reference = renderer.reference(256).mean;
  EXPECT_LT(compare_images(renderer.frame(*GetParam()), reference, 1.0F).value().relative_rmse, 0.25);
}

INSTANTIATE_TEST_SUITE_P(Registry, UnderAnEnvironment, ::testing::ValuesIn(all_methods().begin(), all_methods().end()),
                         [](const auto& test) { return test.param->info.name; });

// A sun of one texel in 512 columns that has a third of all light, whose mirror image in the square is in
// the image.
Environment sunny_environment() {
  constexpr int width = 512, height = width / 2;
  Image map(width, height, 3, 1.0F);
  Environment environment{.name = "sunny", .radiance = std::make_shared<const Image>(map)};
  const glm::dvec2 at = environment_uv(environment, glm::normalize(glm::dvec3(0.12, 0.1, 1.0)));
  for (float& channel : map.at(static_cast<int>(at.x * width), static_cast<int>(at.y * height))) channel = 4e4F;
  environment.radiance = std::make_shared<const Image>(std::move(map));
  return environment;
}

Scene sunny_square(float roughness) {
  constexpr BaseBrdf brdf{NormalDistribution::ggx, GeometryTerm::smith, FresnelTerm::schlick, true};
  return lit_square({}, {.brdf = brdf, .roughness = roughness}, sunny_environment());
}

// The errors of the mean over the image, and of each pixel's radiance.
struct SunErrors {
  double mean, picture;
  [[nodiscard]] bool are_below(double most) const { return std::abs(mean) < 0.03 && picture < most; }
};

SunErrors errors_of(const Image& picture, const Image& reference) {
  return {covered_mean(picture) / covered_mean(reference) - 1.0,
          compare_images(picture, reference, 1.0F).value().relative_rmse};
}

constexpr glm::ivec2 sunny_size{24, 24};

// No map at all: methods and reference see one lobe. With the sun in the maps the mean was off by up to all of it. At
// roughness 0.1 the highlight is hardly larger than a pixel, whose middle alone a frame looks at: there the mean
// counts.
TEST(SmallSunInAnEnvironment, IsWhatTheReferenceSeesOfItAtEveryRoughness) {
  TestRenderer renderer(sunny_square(0.1F), sunny_size);
  for (const auto& [roughness, most] : {std::pair(0.1F, 1.0), {0.3F, 0.04}, {0.5F, 0.04}, {1.0F, 0.04}}) {
    renderer.update(sunny_square(roughness));
    const SunErrors errors = errors_of(renderer.frame(find_method("direct")), renderer.reference(128).mean);
    EXPECT_TRUE(errors.are_below(most)) << "roughness " << roughness << ": mean " << errors.mean << ", image "
                                        << errors.picture;
  }
}

TEST(SmallSunInAnEnvironment, IsMissedWhereItIsLostAndWhereItCountsTwice) {
  const Scene scene = sunny_square(0.5F);
  const Image reference = TestRenderer(scene, sunny_size).reference(32).mean;
  const SunsApart apart = suns_apart(*scene.environment);
  const SmallSun sun = apart.suns.at(0);
  Scene lost = scene, twice = scene;
  lost.environment = apart.rest;
  twice.lights = {DirectionalLight{glm::vec3(-sun.direction), glm::vec3(sun.irradiance)}};
  for (const Scene& wrong : {lost, twice})
    EXPECT_FALSE(errors_of(TestRenderer(wrong, sunny_size).frame(find_method("direct")), reference).are_below(0.25));
}

// Two lamps of a texel each, one of them seen in the square.
TEST(SmallSunInAnEnvironment, IsOneOfTwo) {
  Scene scene = sunny_square(0.5F);
  Image map = *scene.environment->radiance;
  const glm::dvec2 at = environment_uv(*scene.environment, glm::normalize(glm::dvec3(-0.7, -0.3, 1.0)));
  for (float& channel : map.at(static_cast<int>(at.x * map.width), static_cast<int>(at.y * map.height))) channel = 6e4F;
  scene.environment->radiance = std::make_shared<const Image>(std::move(map));
  TestRenderer renderer(scene, sunny_size);
  ASSERT_EQ(renderer.gpu_scene().environment()->sun_count(), 2U);
  const Image reference = renderer.reference(128).mean;
  EXPECT_TRUE(errors_of(renderer.frame(find_method("direct")), reference).are_below(0.04));
  const SunsApart apart = suns_apart(*scene.environment);
  for (const SmallSun& only : apart.suns) {
    Scene wrong = scene;
    wrong.environment = apart.rest;
    wrong.lights = {DirectionalLight{glm::vec3(-only.direction), glm::vec3(only.irradiance)}};
    EXPECT_FALSE(errors_of(TestRenderer(wrong, sunny_size).frame(find_method("direct")), reference).are_below(0.25));
  }
}

// Modules that sum over texels, and that look at their neighbours, among them.
TEST(SmallSunInAnEnvironment, IsTheSameForEveryMethod) {
  Scene scene = sunny_square(0.3F);
  Image normals = constant_normals(16, 16, {0.0F, 0.0F, 1.0F});
  normals.at(0, 0)[0] += 2e-5F;
  scene.materials[0].normal_map = TextureMap{"normals", std::make_shared<const Image>(std::move(normals)), {}};
  TestRenderer renderer(scene, sunny_size);
  const Image direct = renderer.frame(find_method("direct"));
  for (const char* const name : {"exact", "specular_aa", "leadr"})
    EXPECT_LT(compare_images(renderer.frame(find_method(name)), direct, 1.0F).value().relative_rmse, 0.01) << name;
}

// Radiance of a flat surface at one point of the picture by a sum over directions that shares no code with the shaders.
double blinn_phong_under(const Environment& environment, double exponent, std::size_t channel) {
  constexpr int rings = 400;
  constexpr int sectors = 800;
  const glm::dvec3 wo(0, 0, 1);
  double sum = 0;
  for (int i = 0; i < rings; ++i) {
    const double z = (i + 0.5) / rings;
    for (int j = 0; j < sectors; ++j) {
      const double azimuth = 2.0 * pi * (j + 0.5) / sectors;
      const double r = std::sqrt(1.0 - z * z);
      const glm::dvec3 wi(r * std::cos(azimuth), r * std::sin(azimuth), z);
      const double density = (exponent + 1.0) / (2.0 * pi) * std::pow(glm::normalize(wi + wo).z, exponent);
      sum += density * environment_radiance(environment, wi)[static_cast<int>(channel)];
    }
  }
  return sum * 2.0 * pi / (rings * sectors);
}

TEST(ReferenceUnderAnEnvironment, IntegratesItWithinItsStandardError) {
  constexpr BaseBrdf brdf{NormalDistribution::blinn_phong, GeometryTerm::none, FresnelTerm::none, false};
  Scene scene = lit_square({}, {.brdf = brdf, .specular = glm::vec3(0.25F)}, uneven_environment());
  scene.camera.orthographic = true;
  scene.camera.ymag = 1.0F;
  for (const float exponent : {8.0F, 200.0F}) {
    scene.materials[0].lobe_parameter = exponent;
    const Supersampled reference = TestRenderer(scene, {16, 16}).reference(256);
    glm::dvec3 mean(0.0), variance(0.0);
    for (std::size_t i = 0; i < reference.mean.texel_count(); ++i) {
      for (std::size_t c = 0; c < 3; ++c) {
        mean[static_cast<int>(c)] += reference.mean.texels[4 * i + c];
        variance[static_cast<int>(c)] += std::pow(static_cast<double>(reference.standard_error.texels[3 * i + c]), 2.0);
      }
    }
    const auto count = static_cast<double>(reference.mean.texel_count());
    for (std::size_t c = 0; c < 3; ++c) {
      const double error = std::sqrt(variance[static_cast<int>(c)]) / count;
      const double expected = 0.25 * blinn_phong_under(*scene.environment, exponent, c);
      EXPECT_NEAR(mean[static_cast<int>(c)] / count, expected, 4.0 * error + 2e-3 * expected)
          << "exponent " << exponent << ", channel " << c;
      EXPECT_LT(error, 0.02 * expected);
    }
  }
}

// 6144 lights against a sum over 320000 directions, and against drawn directions, on lobes wider than a light's cell.
TEST(ReferenceUnderAnEnvironment, DenseLightsComeToTheSame) {
  constexpr BaseBrdf brdf{NormalDistribution::blinn_phong, GeometryTerm::none, FresnelTerm::none, false};
  Scene scene = lit_square({}, {.brdf = brdf, .specular = glm::vec3(0.25F)}, uneven_environment());
  scene.camera.orthographic = true;
  scene.camera.ymag = 1.0F;
  for (const float exponent : {8.0F, 60.0F}) {
    scene.materials[0].lobe_parameter = exponent;
    TestRenderer renderer(scene, {16, 16});
    const Image dense = renderer.reference(1, 1, Sampling::after_shading, 0, EnvironmentUse::dense).mean;
    for (std::size_t c = 0; c < 3; ++c) {
      const double expected = 0.25 * blinn_phong_under(*scene.environment, exponent, c);
      EXPECT_NEAR(dense.at(8, 8)[c], expected, 0.01 * expected) << "exponent " << exponent << ", channel " << c;
    }
    const double drawn = covered_mean(renderer.reference(64).mean);
    EXPECT_NEAR(covered_mean(dense), drawn, 0.01 * drawn) << "exponent " << exponent;
  }
}

// Filtering after shading and the Lambert term are the same for both ways.
TEST(ReferenceUnderAnEnvironment, DenseLightsComeToTheSamePicture) {
  TestRenderer renderer(
      lit_square(random_normals(8, 8, 0.4F, 5), {.brdf = {}, .roughness = 0.7F}, uneven_environment()), {8, 8});
  const Image drawn = renderer.reference(1024).mean;
  const Image dense = renderer.reference(64, 1, Sampling::after_shading, 0, EnvironmentUse::dense).mean;
  EXPECT_LT(compare_images(dense, drawn, 1.0F).value().relative_rmse, 0.02);
  EXPECT_LT(std::abs(covered_mean(dense) / covered_mean(drawn) - 1.0), 0.005);
}

TEST(ReferenceUnderAnEnvironment, ReflectsAllOfAWhiteFurnace) {
  const SquareMaterial plaster{.brdf = lambert, .base_color = glm::vec3(1.0F), .specular = glm::vec3(0.0F)};
  TestRenderer renderer(lit_square({}, plaster, constant_environment(glm::vec3(1.0F))), {16, 16});
  EXPECT_NEAR(covered_mean(renderer.reference(256).mean), 1.0, 2e-3);
  EXPECT_NEAR(covered_mean(renderer.frame(find_method("direct"))), 1.0, 1e-3);
}

TEST(ReferenceUnderAnEnvironment, IsDeterministicAndNotOfTheTile) {
  TestRenderer renderer(lit_square(random_normals(16, 16, 0.4F, 5), {}, uneven_environment()), {24, 24});
  const Image whole = renderer.reference(16, 3).mean;
  EXPECT_EQ(whole, renderer.reference(16, 3).mean);
  EXPECT_LT(largest_difference(whole, renderer.reference(16, 3, Sampling::after_shading, 16).mean), 1e-4);
  EXPECT_GT(largest_difference(whole, renderer.reference(16, 4).mean), 1e-4);
}

}  // namespace
}  // namespace footprint::testing
