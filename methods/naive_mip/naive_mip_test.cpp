// What `naive_mip` averages: the normals, and of a varying lobe its roughness or its parameter.
#include <gtest/gtest.h>

#include <memory>

#include "renderer/core/error.hpp"
#include "renderer/image/metrics.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint {
const Method& naive_mip_method();
}

namespace footprint::testing {
namespace {

constexpr BaseBrdf vmf{NormalDistribution::vmf, GeometryTerm::none, FresnelTerm::none, false};

// Lobes of kappa 10 and 1000 in stripes one texel wide, over a map of an odd size.
Scene striped_square() {
  Scene scene = square_scene({}, {.brdf = vmf, .specular = glm::vec3(0.5F)});
  auto stripes = std::make_shared<Image>(254, 3, 1);
  for (std::size_t i = 0; i < stripes->texels.size(); ++i) stripes->texels[i] = i % 2 == 0 ? 10.0F : 1000.0F;
  scene.materials[0].lobe_parameter_map = TextureMap{"stripes", stripes, {}};
  return scene;
}

double far_difference(const std::string& text, float kappa) {
  const Image filtered = TestRenderer(striped_square(), {16, 16}).frame(naive_mip_method(), text, {}, 0, 8.0);
  Scene even = square_scene({}, {.brdf = vmf, .specular = glm::vec3(0.5F)});
  even.materials[0].lobe_parameter = kappa;
  const Image constant = TestRenderer(even, {16, 16}).frame(naive_mip_method(), text, {}, 0, 8.0);
  return compare_images(filtered, constant, 1.0F).value().relative_rmse;
}

TEST(NaiveMip, AveragesTheLobeParameterOnRequest) {
  EXPECT_LT(far_difference("naive_mip:averages=lobe", 505.0F), 1e-4);
  EXPECT_LT(far_difference("naive_mip:averages=lobe:storage=fp16", 505.0F), 1e-2);
}

// kappa = 2 / r^4: the means of r = 0.669 and 0.211.
TEST(NaiveMip, AveragesRoughnessByDefault) {
  const double r = 0.5 * (std::pow(2.0 / 10.0, 0.25) + std::pow(2.0 / 1000.0, 0.25));
  EXPECT_LT(far_difference("naive_mip", static_cast<float>(2.0 / std::pow(r, 4.0))), 1e-4);
}

TEST(NaiveMip, BytesHoldNoLobeParameter) {
  EXPECT_THROW((void)far_difference("naive_mip:averages=lobe:storage=unorm8", 1.0F), Error);
}

// Two lobes lean to either side of the mean normal, which for these ridges is the surface's own.
TEST(NaiveMip, LobesTurnWithTheMeanNormal) {
  Image ridges(64, 1, 4, 1.0F);
  for (int x = 0; x < ridges.width; ++x) {
    const glm::vec3 normal(x % 2 == 0 ? 0.6F : -0.6F, 0.0F, 0.8F);
    std::copy_n(&normal.x, 3, ridges.at(x, 0).begin());
  }
  const auto far = [](const Image& normals) {
    Scene scene = square_scene(normals, {.brdf = vmf, .specular = glm::vec3(0.5F)});
    scene.materials[0].lobes = {{.axis = {0.6F, 0.0F, 0.8F}, .parameter = 30.0F, .weight = 0.5F},
                                {.axis = {-0.6F, 0.0F, 0.8F}, .parameter = 30.0F, .weight = 0.5F}};
    return TestRenderer(scene, {16, 16}).frame(naive_mip_method(), {}, {}, 0, 4.0);
  };
  EXPECT_LT(largest_difference(far(ridges), far({})), 1e-5);
}

}  // namespace
}  // namespace footprint::testing
