// Emitted light is one image for the reference and every method: it changes no error.
#include "renderer/pipeline/emitted_light.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "renderer/image/metrics.hpp"
#include "renderer/pipeline/base_surface.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/shadow_scenes.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing {
namespace {

constexpr glm::ivec2 emitted_size{24, 24};
constexpr float dim_exposure = 0.01F;  // displays nothing that is clamped

// Bumps under a lamp, and finer than a pixel a texture of light in random texels.
Scene shining_bumps() {
  Scene scene = square_scene(random_normals(64, 64, 0.5F, 3), {});
  Image light = random_normals(128, 128, 0.9F, 5);
  scene.materials[0].emission = {2.0F, 1.0F, 0.5F};
  scene.materials[0].emission_map =
      TextureMap{"light",
                 std::make_shared<const Image>(mapped(light, 3,
                                                      [](const auto& in, const auto& out) {
                                                        for (std::size_t c = 0; c < 3; ++c)
                                                          out[c] = in[c] > 0.3F ? 1.0F : 0.0F;
                                                      })),
                 {}};
  return scene;
}

Scene without_light(Scene scene) {
  scene.materials[0].emission = glm::vec3(0.0F);
  return scene;
}

TEST(EmittedLight, IsInNoError) {
  const Scene scene = shining_bumps(), dark_scene = without_light(scene);
  TestRenderer shining(scene, emitted_size), dark(dark_scene, emitted_size);
  const Supersampled reference = shining.reference(64), dark_reference = dark.reference(64);
  const auto error = [](const Image& picture, const Image& truth) {
    return normalized_color(picture, truth, dim_exposure).value();
  };
  for (const FootprintFilter& filter : {default_footprint_filter, filter_of("trilinear")}) {
    const Image frame = shining.frame(base_surface(), {}, filter), dark_frame = dark.frame(base_surface(), {}, filter);
    const double with = error(frame, reference.mean), without = error(dark_frame, dark_reference.mean);
    EXPECT_GT(without, 1e-5);
    EXPECT_NEAR(with, without, 1e-4 * without);  // what is left is rounding of sums
    EXPECT_GT(error(frame, dark_frame), 1e-3) << "the light is there";
  }
  ASSERT_TRUE(reference.halves && dark_reference.halves);
  EXPECT_NEAR(error(reference.halves->first, reference.halves->second),
              error(dark_reference.halves->first, dark_reference.halves->second), 1e-7);
  EXPECT_EQ(reference.standard_error.texels, dark_reference.standard_error.texels);
}

TEST(EmittedLight, IsDrawnAgainForAnotherViewAndAnotherScene) {
  Scene scene = shining_bumps();
  scene.lights.clear();
  TestRenderer renderer(scene, emitted_size);
  const Image first = renderer.frame(base_surface());
  EXPECT_GT(largest_difference(renderer.frame(base_surface(), {}, {}, 0, 0.5), first), 0.1);
  EXPECT_EQ(renderer.frame(base_surface()).texels, first.texels);
  scene.materials[0].emission *= 2.0F;
  renderer.update(scene);
  Image twice = first;
  for (std::size_t i = 0; i < twice.texels.size(); ++i)
    if (i % 4 < 3) twice.texels[i] *= 2.0F;
  EXPECT_LT(largest_difference(renderer.frame(base_surface()), twice), 1e-5);
}

// The program of emitted light has none of the textures of shadows.
TEST(EmittedLight, IsTheSameInTheShadow) {
  Scene scene = box_over_floor();
  scene.lights = {DirectionalLight{.direction = {0, 0, -1}, .illuminance = glm::vec3(3)}};
  const Image dark = TestRenderer(scene, emitted_size).frame(base_surface());
  scene.materials[0].emission = {0.5F, 0.25F, 0.125F};
  TestRenderer renderer(scene, emitted_size);
  ASSERT_TRUE(has(renderer.gpu_scene().effects(), Effect::cast_shadow));
  const Image shining = renderer.frame(base_surface());
  for (std::size_t i = 0; i < shining.texels.size(); i += 4) {
    if (dark.texels[i + 3] < 1.0F) continue;
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(shining.texels[i + c] - dark.texels[i + c], scene.materials[0].emission[static_cast<int>(c)], 1e-5);
  }
}

TEST(EmittedLight, IsNotCountedAsWork) {
  const Scene scene = shining_bumps();
  const PixelWork with = TestRenderer(scene, emitted_size).work(base_surface(), {}, {});
  EXPECT_EQ(with.lookups, TestRenderer(without_light(scene), emitted_size).work(base_surface(), {}, {}).lookups);
}

}  // namespace
}  // namespace footprint::testing
