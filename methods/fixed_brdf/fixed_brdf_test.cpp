// What sets `fixed_brdf` apart: normals are filtered, reflectance is the finest level's own at any distance.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "renderer/image/metrics.hpp"
#include "renderer/pipeline/base_surface.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint {
const Method& fixed_brdf_method();
}

namespace footprint::testing {
namespace {

constexpr BaseBrdf blinn_phong{NormalDistribution::blinn_phong, GeometryTerm::none, FresnelTerm::none, true};

double difference(const Image& picture, const Image& reference) {
  return compare_images(picture, reference, 1.0F).value().relative_rmse;
}

// Roughness of two values in stripes one texel wide: any filter of it gives neither.
Scene striped_square(const Image& normals) {
  Scene scene = square_scene(normals, {});
  auto stripes = std::make_shared<Image>(256, 1, 2);
  for (int x = 0; x < stripes->width; ++x) stripes->at(x, 0)[0] = x % 2 == 0 ? 0.2F : 0.7F;
  scene.materials[0].metallic_roughness_map = TextureMap{.name = "stripes", .image = stripes, .coordinates = {}};
  return scene;
}

// Seen from far away, where a pixel covers hundreds of texels.
TEST(FixedBrdf, RoughnessIsTheFinestLevelsAtAnyDistance) {
  TestRenderer renderer(striped_square({}), {15, 15});
  for (const double distance : {0.05, 1.0, 4.0}) {
    const Image finest = renderer.frame(base_surface(), {}, {}, 0, distance);
    EXPECT_LT(difference(renderer.frame(fixed_brdf_method(), {}, {}, 0, distance), finest), 1e-6) << distance;
  }
}

// Normals that lean to the left and to the right by turns, one texel each.
Image ridges(float sine) {
  Image image(256, 1, 4, 1.0F);
  for (int x = 0; x < image.width; ++x) {
    const glm::vec3 normal(x % 2 == 0 ? sine : -sine, 0.0F, std::sqrt(1.0F - sine * sine));
    std::copy_n(&normal.x, 3, image.at(x, 0).begin());
  }
  return image;
}

// The mean of the two tilts is up, also where it is zero and has no direction: seen from afar, the picture is that of
// an even surface with a facet's lobe.
TEST(FixedBrdf, NormalsAreFilteredAndTheLobeIsLeft) {
  const SquareMaterial settings{.brdf = blinn_phong, .roughness = 0.4F};
  const Image even = TestRenderer(square_scene({}, settings), {16, 16}).frame(base_surface());
  for (const float sine : {0.6F, 1.0F}) {
    const Image ridged = TestRenderer(square_scene(ridges(sine), settings), {16, 16}).frame(fixed_brdf_method());
    EXPECT_LT(difference(ridged, even), 1e-5) << sine;
  }
}

// Figure 8: the highlight of a far bumpy surface is too bright, as that of a single facet is.
TEST(FixedBrdf, IsTooShinyFarAway) {
  Scene scene = square_scene(random_normals(256, 256, 0.4F, 9),
                             {.brdf = blinn_phong, .base_color = glm::vec3(0.0F), .specular = glm::vec3(0.5F)});
  scene.materials[0].lobe_parameter = 200.0F;
  TestRenderer renderer(scene, {16, 16});
  const Image fixed = renderer.frame(fixed_brdf_method());
  const Image reference = renderer.reference(1024).mean;
  EXPECT_GT(*std::ranges::max_element(fixed.texels), 2.0F * *std::ranges::max_element(reference.texels));
}

}  // namespace
}  // namespace footprint::testing
