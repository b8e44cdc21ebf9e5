// Base BRDFs of several lobes, of anisotropic lobes and of maps, by every method. A method that honours them equals
// `direct` where nothing needs filtering, and keeps the reference's energy over a footprint.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "methods/registry.hpp"
#include "renderer/image/metrics.hpp"
#include "renderer/pipeline/base_surface.hpp"
#include "tests/methods/method_number.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/sweep.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing {
namespace {

constexpr std::array<BaseBrdf, 3> lobed_brdfs = {{
    {NormalDistribution::ggx, GeometryTerm::smith, FresnelTerm::schlick, true},
    {NormalDistribution::blinn_phong, GeometryTerm::none, FresnelTerm::none, true},
    {NormalDistribution::vmf, GeometryTerm::tan, FresnelTerm::schlick, true},
}};

class EveryMethodsBaseBrdf : public ::testing::TestWithParam<const Method*> {
 protected:
  /// One of the three for the method by default, another for the next method.
  static std::vector<BaseBrdf> some_brdfs() { return sweep(lobed_brdfs, 1, method_number(*GetParam())); }

  static bool honours(Effect effect) { return has(GetParam()->info.honours, effect); }
  static double difference_from_direct(TestRenderer& renderer, double distance) {
    const Image direct = renderer.frame(find_method("direct"), {}, {}, 0, distance);
    const Image picture = renderer.frame(*GetParam(), {}, {}, 0, distance);
    return compare_images(picture, direct, 1.0F).value().relative_rmse;
  }
};

// The parameter of a lobe as wide as a GGX one of `alpha`.
float parameter(const BaseBrdf& brdf, float alpha) {
  return static_cast<float>(lobe_from_alpha(brdf.distribution, alpha).parameter);
}

std::vector<FacetLobe> two_lobes(const BaseBrdf& brdf) {
  return {{.axis = {0.6F, 0.0F, 0.8F}, .parameter = parameter(brdf, 0.2F), .weight = 0.6F},
          {.axis = {-0.48F, 0.36F, 0.8F}, .parameter = parameter(brdf, 0.4F), .weight = 0.7F}};
}

TEST_P(EveryMethodsBaseBrdf, SeveralLobesAreDirectsOnAConstantMap) {
  for (const BaseBrdf& brdf : some_brdfs()) {
    for (const glm::vec3& normal : {glm::vec3(0, 0, 1), glm::vec3(0.28F, 0, 0.96F)}) {
      Image normals = constant_normals(16, 16, normal);
      normals.at(0, 0)[0] += 2e-5F;  // keeps a flat map from being left out
      Scene scene = square_scene(normals, {.brdf = brdf, .specular = glm::vec3(0.5F)});
      scene.materials[0].lobes = two_lobes(brdf);
      TestRenderer renderer(scene, {24, 24});
      for (const double distance : {0.05, 4.0}) {
        if (honours(Effect::multi_lobe)) {
          EXPECT_LT(difference_from_direct(renderer, distance), 1e-3) << distance;
        } else {
          EXPECT_GT(difference_from_direct(renderer, distance), 0.02) << distance;
        }
      }
    }
  }
}

TEST_P(EveryMethodsBaseBrdf, SeveralLobesStayFiniteAtTheLimits) {
  for (const BaseBrdf& brdf : some_brdfs()) {
    Scene scene = square_scene(random_normals(9, 5, 0.999F, 3), {.brdf = brdf});
    scene.materials[0].lobes = {{.axis = {0.99F, 0, 0.14106736F}, .parameter = parameter(brdf, 0.0F), .weight = 1e-6F},
                                {.axis = {0, 0, 1}, .parameter = parameter(brdf, 0.999F), .weight = 1e3F}};
    TestRenderer renderer(scene, {16, 16});
    for (const double distance : {0.05, 20.0}) {
      for (const float value : renderer.frame(*GetParam(), {}, {}, 0, distance).texels) {
        ASSERT_TRUE(std::isfinite(value) && value >= 0.0F);
      }
    }
  }
}

constexpr std::array<BaseBrdf, 3> stretched_brdfs = {{
    {NormalDistribution::ggx, GeometryTerm::smith, FresnelTerm::schlick, true},
    {NormalDistribution::beckmann, GeometryTerm::smith, FresnelTerm::none, true},
    {NormalDistribution::beckmann, GeometryTerm::ward, FresnelTerm::schlick, false},
}};

// Methods without the effect have the round mean, so their images are those of a round material.
TEST_P(EveryMethodsBaseBrdf, AnisotropicLobesAreDirectsOnAConstantMapOrTheirRoundMean) {
  for (const BaseBrdf& brdf : stretched_brdfs) {
    for (const glm::vec3& normal : {glm::vec3(0, 0, 1), glm::vec3(0.28F, 0, 0.96F)}) {
      Image normals = constant_normals(16, 16, normal);
      normals.at(0, 0)[0] += 2e-5F;  // keeps a flat map from being left out
      Scene scene = square_scene(normals, {.brdf = brdf, .specular = glm::vec3(0.5F)});
      Material& material = scene.materials[0];
      material.lobe_parameter = 0.2F;
      Scene round = scene;
      material.anisotropy = Anisotropy{0.6F, 0.5F};
      round.materials[0].lobe_parameter = static_cast<float>(lobe_of(material).parameter);
      TestRenderer renderer(scene, {24, 24});
      TestRenderer round_renderer(round, {24, 24});
      for (const double distance : {0.05, 4.0}) {
        if (honours(Effect::anisotropic_lobe)) {
          EXPECT_LT(difference_from_direct(renderer, distance), 1e-3) << distance;
        } else {
          const Image picture = renderer.frame(*GetParam(), {}, {}, 0, distance);
          EXPECT_EQ(picture.texels, round_renderer.frame(*GetParam(), {}, {}, 0, distance).texels) << distance;
          EXPECT_GT(difference_from_direct(renderer, distance), 0.02) << distance;
        }
      }
    }
  }
}

// A map of anisotropy with one value in every texel but a few: the picture of the constant, for every method.
TEST_P(EveryMethodsBaseBrdf, MapsOfAnisotropyAreWhatTheirTexelsSay) {
  Scene scene = square_scene(constant_normals(16, 16, {0.28F, 0, 0.96F}),
                             {.brdf = stretched_brdfs[0], .specular = glm::vec3(0.5F)});
  Material& material = scene.materials[0];
  Image widths(16, 16, 2, 0.0F), axes(16, 16, 2, 0.0F);
  for (std::size_t i = 0; i < widths.texel_count(); ++i) widths.texels[2 * i] = 0.45F;
  const Anisotropy one{0.6F, 0.5F};
  for (std::size_t i = 0; i < axes.texel_count(); ++i) {
    axes.texels[2 * i] = one.strength * one.strength * std::cos(2.0F * one.rotation);
    axes.texels[2 * i + 1] = one.strength * one.strength * std::sin(2.0F * one.rotation);
  }
  axes.at(0, 0)[0] = -axes.at(0, 0)[0];  // in a corner: the map varies
  widths.at(0, 0)[0] = 0.452F;
  material.metallic_roughness_map = TextureMap{"widths", std::make_shared<const Image>(widths), {}};
  material.anisotropy = one;
  Scene constant = scene;
  if (honours(Effect::roughness_variation)) material.anisotropy = Anisotropy{0.1F, 2.0F};  // not read beside the map
  material.anisotropy_map = TextureMap{"axes", std::make_shared<const Image>(axes), {}};
  TestRenderer mapped(scene, {24, 24}), plain(constant, {24, 24});
  const Image picture = mapped.frame(*GetParam(), {}, {}, 0, 0.05);  // the middle alone
  EXPECT_LT(error_of(picture, plain.frame(*GetParam(), {}, {}, 0, 0.05)), 1e-3);
}

TEST_P(EveryMethodsBaseBrdf, AnisotropicLobesStayFiniteAtTheLimits) {
  for (const BaseBrdf& brdf : stretched_brdfs) {
    for (const float roughness : {0.0F, 0.3F, 1.0F}) {
      for (const float strength : {1e-4F, 1.0F}) {
        Scene scene = square_scene(random_normals(9, 5, 0.999F, 3), {.brdf = brdf, .roughness = roughness});
        scene.materials[0].anisotropy = Anisotropy{strength, 0.8F};
        TestRenderer renderer(scene, {16, 16});
        for (const double distance : {0.05, 20.0}) {
          for (const float value : renderer.frame(*GetParam(), {}, {}, 0, distance).texels) {
            ASSERT_TRUE(std::isfinite(value) && value >= 0.0F) << roughness << " " << strength;
          }
        }
      }
    }
  }
}

// The map's middle, where the camera looks, has one value; around it are others.
template <class Fill>
TextureMap uniform_in_the_middle(int channels, Fill fill) {
  auto image = std::make_shared<Image>(33, 21, channels);
  for (int y = 0; y < image->height; ++y) {
    for (int x = 0; x < image->width; ++x) {
      const bool middle = x > 10 && x < 22 && y > 5 && y < 15;
      for (int c = 0; c < channels; ++c) image->at(x, y)[static_cast<std::size_t>(c)] = fill(middle ? -1 : x + y, c);
    }
  }
  return {"map", image, {}};
}

TEST_P(EveryMethodsBaseBrdf, AMapOfLobeParametersIsDirectsAtMagnificationWhereItIsUniform) {
  if (!honours(Effect::roughness_variation)) GTEST_SKIP();
  for (const BaseBrdf& brdf : some_brdfs()) {
    Scene scene = square_scene({}, {.brdf = brdf, .specular = glm::vec3(0.5F)});
    scene.materials[0].lobe_parameter_map = uniform_in_the_middle(1, [&](int i, int /*channel*/) {
      return parameter(brdf, i < 0 ? 0.25F : 0.1F + 0.01F * static_cast<float>(i % 5));
    });
    TestRenderer renderer(scene, {24, 24});
    EXPECT_LT(difference_from_direct(renderer, 0.05), 1e-3);
    // The image equals that of one parameter.
    const Image mapped = renderer.frame(*GetParam(), {}, {}, 0, 0.05);
    scene.materials[0].lobe_parameter_map.reset();
    scene.materials[0].lobe_parameter = parameter(brdf, 0.25F);
    const Image constant = TestRenderer(scene, {24, 24}).frame(*GetParam(), {}, {}, 0, 0.05);
    EXPECT_LT(compare_images(mapped, constant, 1.0F).value().relative_rmse, 1e-3);
  }
}

// The pipeline filters F0 for all: as `direct`, near and far, beside a normal map with coordinates of its own.
TEST_P(EveryMethodsBaseBrdf, ASpecularMapIsDirects) {
  for (const BaseBrdf& brdf : some_brdfs()) {
    Image normals = constant_normals(16, 16, glm::vec3(0.28F, 0, 0.96F));
    Scene scene = square_scene(normals, {.brdf = brdf, .specular = {1.0F, 0.5F, 0.25F}});
    scene.materials[0].specular_map =
        uniform_in_the_middle(3, [](int i, int c) { return i < 0 ? 0.4F : 0.1F * static_cast<float>((i + c) % 9); });
    scene.materials[0].specular_map->coordinates.transform = {3.0F, 0.0F, 0.0F, 2.0F, 0.3F, 0.1F};
    TestRenderer renderer(scene, {24, 24});
    for (const double distance : {0.05, 1.0, 6.0}) {
      EXPECT_LT(difference_from_direct(renderer, distance), 1e-3) << distance;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryMethodsBaseBrdf,
                         ::testing::ValuesIn(all_methods().begin(), all_methods().end()),
                         [](const auto& test) { return test.param->info.name; });

// Where all slopes are equal, LEAN's stretched lobe is the anisotropic Beckmann lobe. Its Gaussians are densities over
// solid angle, Beckmann's is one over projected area, so they differ by the cosine of the half vector.
TEST(Lean, HasTheCovarianceOfAnAnisotropicBaseOnConstantSlopes) {
  Image normals = constant_normals(16, 16, {0, 0, 1});
  normals.at(0, 0)[0] += 2e-5F;  // keeps the flat map from being left out
  Scene scene =
      square_scene(normals, {.brdf = {NormalDistribution::beckmann, GeometryTerm::smith, FresnelTerm::schlick, true},
                             .specular = glm::vec3(0.5F)});
  scene.materials[0].lobe_parameter = 0.15F;
  scene.materials[0].anisotropy = Anisotropy{0.7F, 0.6F};
  TestRenderer renderer(scene, {24, 24});
  const Image direct = renderer.frame(find_method("direct"));
  EXPECT_LT(error_of(renderer.frame(find_method("lean"), "lean:roughness=stretched"), direct), 1e-3);
  EXPECT_LT(error_of(renderer.frame(find_method("cells"), "cells:coordinates=slopes"), direct), 1e-3);
  const Image shading = renderer.frame(find_method("lean"), "lean:roughness=shading");
  EXPECT_LT(error_of(shading, direct), 0.05);
  EXPECT_LT(error_of(renderer.frame(find_method("lean"), "lean:roughness=moments"), shading), 1e-3);
  for (const char* const method : {"leadr:roughness=shading", "leadr:roughness=moments"})
    EXPECT_LT(error_of(renderer.frame(find_method("leadr"), method), direct), 0.05) << method;
  EXPECT_GT(error_of(renderer.frame(find_method("toksvig")), direct), 0.2) << "the round mean";
}

// Two brushed directions by turns, texel by texel: seen from afar the reference is the mean of both constants'
// pictures. LEAN's Gaussian has the mean covariance, and a constant mean of anisotropy has none.
TEST(MapOfAnisotropy, IsTheMeanOfItsLobesFarAway) {
  Scene scene = square_scene({}, {.brdf = stretched_brdfs[0], .specular = glm::vec3(0.5F)});
  Material& material = scene.materials[0];
  constexpr float strength = 0.7F;
  Image axes(64, 64, 2, 0.0F), widths(64, 64, 2, 0.0F);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      axes.at(x, y)[0] = strength * strength * ((x + y) % 2 == 0 ? 1.0F : -1.0F);
      widths.at(x, y)[0] = 0.4F;
    }
  }
  material.metallic_roughness_map = TextureMap{"widths", std::make_shared<const Image>(widths), {}};
  const auto reference = [&](const Scene& of) { return TestRenderer(of, {16, 16}).reference(256).mean; };
  material.anisotropy = Anisotropy{strength, 0.0F};
  const Image along = reference(scene);
  material.anisotropy->rotation = 0.5F * std::numbers::pi_v<float>;
  const Image across = reference(scene);
  Image mean = along;
  for (std::size_t i = 0; i < mean.texels.size(); ++i) mean.texels[i] = 0.5F * (along.texels[i] + across.texels[i]);
  material.anisotropy = Anisotropy{0.0F, 0.0F};
  material.anisotropy_map = TextureMap{"axes", std::make_shared<const Image>(axes), {}};
  const Image turns = reference(scene);
  EXPECT_LT(error_of(turns, mean), 0.01);
  EXPECT_GT(error_of(turns, along), 0.1);
  TestRenderer renderer(scene, {16, 16});
  EXPECT_LT(error_of(renderer.frame(find_method("exact")), mean), 0.01);
  material.anisotropy_map.reset();
  EXPECT_GT(error_of(reference(scene), mean), 0.05) << "the mean of the axes is round";
}

// Xu et al. 2017 name anisotropic base BRDFs as a limit of their round lobes, which take the round mean. A flat map
// leaves nothing else to err in: LEAN, with the covariance of the base lobe, is the reference there. With a round base
// both are.
TEST(XuVmf, IsLimitedToRoundBaseBrdfsAsStated) {
  Image normals = constant_normals(16, 16, {0, 0, 1});
  normals.at(0, 0)[0] += 2e-5F;  // keeps the flat map from being left out
  Scene scene =
      square_scene(normals, {.brdf = {NormalDistribution::beckmann, GeometryTerm::smith, FresnelTerm::none, false},
                             .specular = glm::vec3(0.5F)});
  scene.materials[0].lobe_parameter = 0.15F;
  const auto errors = [](const Scene& of) {
    TestRenderer renderer(of, {32, 32});
    const Image reference = renderer.reference(16).mean;
    return std::array{error_of(renderer.frame(find_method("xu_vmf")), reference),
                      error_of(renderer.frame(find_method("lean")), reference)};
  };
  const auto [xu_round, lean_round] = errors(scene);
  EXPECT_LT(lean_round, 0.02);
  EXPECT_LT(xu_round, 0.1);
  scene.materials[0].anisotropy = Anisotropy{0.7F, 0.6F};
  const auto [xu, lean] = errors(scene);
  EXPECT_LT(lean, 0.02);
  EXPECT_GT(xu, 0.2);
  EXPECT_GT(xu, 10.0 * lean);
}

// Far away a map of F0 is its mean: of a checkerboard of two values, for the reference as for a filtered frame.
TEST(SpecularMap, IsItsMeanFarAway) {
  const BaseBrdf plain{NormalDistribution::vmf, GeometryTerm::none, FresnelTerm::none, false};
  Scene scene = square_scene({}, {.brdf = plain, .roughness = 0.6F, .specular = glm::vec3(1.0F)});
  const Scene mean = [&] {
    Scene out = scene;
    out.materials[0].dielectric_specular = {0.3F, 0.45F, 0.5F};
    return out;
  }();
  auto checker = std::make_shared<Image>(64, 64, 3);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const glm::vec3 value = (x + y) % 2 == 0 ? glm::vec3(0.2F, 0.1F, 1.0F) : glm::vec3(0.4F, 0.8F, 0.0F);
      std::copy_n(&value.x, 3, checker->at(x, y).begin());
    }
  }
  scene.materials[0].specular_map = TextureMap{"checker", checker, {}};
  const Image expected = TestRenderer(mean, {8, 8}).frame(base_surface());
  EXPECT_LT(compare_images(TestRenderer(scene, {8, 8}).frame(base_surface()), expected, 1.0F).value().relative_rmse,
            1e-5);
  const Image reference = TestRenderer(scene, {8, 8}).reference(4096).mean;
  const Image mean_reference = TestRenderer(mean, {8, 8}).reference(4096).mean;
  // The standard error of 4096 draws of one of two values: 0.013, to 5% over 192 of them.
  EXPECT_LT(compare_images(reference, mean_reference, 1.0F).value().relative_rmse, 0.016);
}

}  // namespace
}  // namespace footprint::testing
