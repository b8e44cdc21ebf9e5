// Which pixels a reference does not resolve: a mirror under a punctual light, and nothing where it converges.
#include "renderer/pipeline/supersample.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "renderer/image/metrics.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing {
namespace {

constexpr int frame_edge = 32;

Scene scene_of(float roughness) {
  SquareMaterial material;
  material.roughness = roughness;
  material.metallic = 1.0F;
  material.base_color = glm::vec3(0.9F);
  return square_scene(random_normals(256, 256, 0.5F, 7), material);
}

Supersampled square(float roughness, int spp) {
  TestRenderer renderer(scene_of(roughness), {frame_edge, frame_edge});
  return renderer.reference(spp, 3);
}

TEST(Unresolved, AreThePixelsOfAMirrorUnderAPointLight) {
  const std::size_t sharp = pixel_count(unresolved(square(0.15F, 64), 1.0F));
  EXPECT_GT(sharp, 20U);
  EXPECT_LT(sharp, static_cast<std::size_t>(frame_edge * frame_edge));
  EXPECT_EQ(pixel_count(unresolved(square(0.5F, 64), 1.0F)), 0U);
}

// Seeds disagree there about much of the light, far more than elsewhere: the share of it that they do not agree on.
TEST(Unresolved, AreWhereSeedsDisagree) {
  TestRenderer renderer(scene_of(0.15F), {frame_edge, frame_edge});
  const Supersampled one = renderer.reference(64, 3), other = renderer.reference(64, 4);
  const Image mask = unresolved(one, 1.0F);
  std::array<double, 2> off{}, count{};
  for (std::size_t i = 0; i < mask.texels.size(); ++i) {
    const auto kind = static_cast<std::size_t>(mask.texels[i]);
    const float a = one.mean.texels[4 * i], b = other.mean.texels[4 * i];
    off.at(kind) += std::abs(a - b) / std::max(a + b, 1e-6F);
    count.at(kind) += 1.0;
  }
  ASSERT_GT(count[1], 0.0);
  EXPECT_GT(off[1] / count[1], 2.0 * off[0] / count[0]);
}

TEST(Unresolved, DoNotCountWhereTheyCannotBeSeen) {
  const Supersampled mirror = square(0.15F, 64);
  EXPECT_EQ(pixel_count(unresolved(mirror, 1e-6F)), 0U);
  EXPECT_EQ(pixel_count(unresolved(mirror, 1.0F, {std::numeric_limits<double>::infinity(), 0.0})), 0U);
}

TEST(Unresolved, AreLeftOutOfEveryFigure) {
  Supersampled mirror = square(0.15F, 64);
  const Image mask = unresolved(mirror, 1.0F);
  Image picture = mirror.mean;
  for (std::size_t i = 0; i < mask.texels.size(); ++i) {
    if (mask.texels[i] > 0.0F) picture.texels[4 * i] = 1000.0F;
  }
  EXPECT_GT(compare_images(picture, mirror.mean, 1.0F)->relative_rmse, 1.0);
  const std::size_t before = object_pixel_count(mirror.mean);
  leave_out(mirror, mask);
  EXPECT_EQ(compare_images(picture, mirror.mean, 1.0F)->relative_rmse, 0.0);
  EXPECT_EQ(object_pixel_count(mirror.mean), before - pixel_count(mask));
  EXPECT_EQ(object_pixel_count(mirror.halves->first), before - pixel_count(mask));
}

// What is noisy all over is noise: left out, its bright pixels would leave the dark ones as the figure.
TEST(Unresolved, AreNoneWhereAllPixelsWouldBe) {
  Supersampled noisy;
  noisy.spp = 4;
  noisy.mean = Image(4, 4, 4, 1.0F);
  noisy.standard_error = Image(4, 4, 3, 0.9F);
  EXPECT_EQ(pixel_count(unresolved(noisy, 1.0F)), 0U);
  EXPECT_EQ(pixel_count(unresolved(noisy, 1.0F, {.relative = 0.5, .displayed = 0.01, .most = 1.0})), 16U);
}

}  // namespace
}  // namespace footprint::testing
