// The base lobe about each texel, where it is more than one number: several lobes with axes of their own, and a width
// that the map varies. Pictures against those of `exact`, which sums texel by texel.
#include <gtest/gtest.h>

#include <memory>

#include "renderer/image/metrics.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint {
const Method& atanasov_bins_method();
const Method& exact_method();
}  // namespace footprint

namespace footprint::testing {
namespace {

constexpr BaseBrdf beckmann{NormalDistribution::beckmann, GeometryTerm::smith, FresnelTerm::schlick, false};

double from_exact(const Scene& scene) {
  TestRenderer renderer(scene, {12, 12});
  return compare_images(renderer.frame(atanasov_bins_method()), renderer.frame(exact_method(), "exact:kernel=areas"),
                        1.0F)
      .value()
      .relative_rmse;
}

// A few texels per pixel, which are looked at one by one, and thousands, which are counted by lists.
TEST(AtanasovLobes, SeveralLobesAreThoseOfEveryTexel) {
  for (const int texels : {48, 768}) {
    Scene scene = square_scene(random_normals(texels, texels, 0.4F, 5), {.brdf = beckmann});
    scene.materials[0].lobes = {
        {.axis = glm::normalize(glm::vec3(0.5F, 0.1F, 1.0F)), .parameter = 0.15F, .weight = 0.4F},
        {.axis = glm::normalize(glm::vec3(-0.2F, -0.3F, 1.0F)), .parameter = 0.1F, .weight = 0.6F}};
    EXPECT_LT(from_exact(scene), texels == 48 ? 1e-3 : 0.03) << texels;
  }
}

// Texels that lean one way are smooth, those that lean the other way are rough.
Scene leaning_roughness(int texels, int rough_texels) {
  Image normals = random_normals(texels, texels, 0.4F, 6);
  Image rough(rough_texels, rough_texels, 2, 0.0F);
  const int share = rough_texels / texels;
  for (int y = 0; y < rough.height; ++y) {
    for (int x = 0; x < rough.width; ++x) rough.at(x, y)[0] = normals.at(x / share, y / share)[0] > 0.0F ? 0.25F : 0.6F;
  }
  Scene scene = square_scene(normals, {.brdf = beckmann});
  scene.materials[0].metallic_roughness_map = TextureMap{"leaning", std::make_shared<const Image>(rough), {}};
  return scene;
}

// Lists have the widths of their classes of texels.
TEST(AtanasovLobes, RoughnessIsThatOfEveryTexel) {
  EXPECT_LT(from_exact(leaning_roughness(48, 96)), 1e-3) << "a finer roughness map";
  for (const int texels : {48, 768}) {
    Scene scene = leaning_roughness(texels, texels);
    EXPECT_LT(from_exact(scene), texels == 48 ? 1e-3 : 0.02) << texels;
    // Two maps that are not looked up alike have the footprint's mean width.
    scene.materials[0].metallic_roughness_map->coordinates.wrap = {Wrap::clamp_to_edge, Wrap::repeat};
    EXPECT_GT(from_exact(scene), 0.4) << texels;
  }
}

}  // namespace
}  // namespace footprint::testing
