// The part of an environment that large bodies hide, in methods and the reference, against geometry and rays.
#include "renderer/pipeline/gpu_environment.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "renderer/image/metrics.hpp"
#include "renderer/pipeline/base_surface.hpp"
#include "renderer/visibility/occluders.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/says.hpp"
#include "tests/support/shadow_scenes.hpp"

namespace footprint::testing {
namespace {

constexpr float wall_height = 0.8F;
constexpr float gap = 0.02F;
constexpr int picture_size = 32;

Scene under_white_sky(Scene scene) {
  scene.environment = constant_environment(glm::vec3(1.0F));
  return scene;
}

// The floor with a wall along its left edge, so long that it counts as endless; not in the plane of the floor's
// vertices.
Scene floor_by_a_wall() {
  Scene scene = under_white_sky(white_floor());
  scene.meshes.push_back(box_mesh({-1.2F, -6.0F, 0.0F}, {-1.0F - gap, 6.0F, wall_height}));
  fit_bounds(scene);
  return scene;
}

// That floor as a metal, seen along it against the wall.
Scene metal_by_a_wall() {
  Scene scene = floor_by_a_wall();
  Material& material = scene.materials.front();
  material.brdf = {NormalDistribution::ggx, GeometryTerm::smith, FresnelTerm::none, false};
  material.roughness = 0.3F;
  material.dielectric_specular = glm::vec3(1.0F);
  const glm::vec3 eye(2.4F, 0.0F, 1.0F), towards = glm::normalize(glm::vec3(-0.2F, 0.0F, 0.0F) - eye);
  const glm::vec3 right = glm::normalize(glm::cross(towards, glm::vec3(0, 0, 1)));
  scene.camera.world = glm::mat4(glm::vec4(right, 0), glm::vec4(glm::cross(right, towards), 0), glm::vec4(-towards, 0),
                                 glm::vec4(eye, 1));
  return scene;
}

double relative_rmse(const Image& picture, const Image& reference) {
  return compare_images(picture, reference, 1.0F).value().relative_rmse;
}

// An endless wall of height H at distance d hides (1 - cos atan(H / d)) / 2 of a floor's irradiance.
TEST(GpuVisibility, AWallHidesItsPartOfTheIrradiance) {
  TestRenderer renderer(floor_by_a_wall(), {picture_size, picture_size});
  const Image picture = renderer.frame(base_surface());
  const Supersampled reference = renderer.reference(64);
  for (int x = 0; x < picture_size; ++x) {
    const double d = gap + 2.0 * (x + 0.5) / picture_size;
    const double expected = 0.5 + 0.5 * d / std::hypot(d, wall_height);
    EXPECT_NEAR(picture.at(x, picture_size / 2)[0], expected, 0.04) << "distance " << d;
    double mean = 0, variance = 0;
    for (int y = 0; y < picture_size; ++y) {
      mean += reference.mean.at(x, y)[0] / picture_size;
      variance += std::pow(static_cast<double>(reference.standard_error.at(x, y)[0]) / picture_size, 2.0);
    }
    EXPECT_NEAR(mean, expected, 4.0 * std::sqrt(variance) + 0.04) << "distance " << d;
  }
}

// Where the mirror image of the view meets the wall nothing is seen, where it passes over it the sky is.
TEST(GpuVisibility, AWallIsInAMirror) {
  TestRenderer renderer(metal_by_a_wall(), {picture_size, picture_size});
  const Image picture = renderer.frame(base_surface());
  const Image reference = renderer.reference(64).mean;
  const auto middle = [](const Image& image, int row) { return image.at(picture_size / 2, row)[0]; };
  int last = picture_size - 1;  // the floor's nearest row
  while (last > 0 && picture.at(picture_size / 2, last)[3] < 1.0F) --last;
  EXPECT_GT(middle(reference, last), 0.9);
  EXPECT_NEAR(middle(picture, last), middle(reference, last), 0.06);
  double lowest = 1;
  for (int row = 0; row <= last; ++row) lowest = std::min<double>(lowest, middle(reference, row));
  EXPECT_LT(lowest, 0.1);
  EXPECT_LT(relative_rmse(picture, reference), 0.12);
  Scene open = metal_by_a_wall();
  open.shadows.cast = false;
  EXPECT_GT(relative_rmse(TestRenderer(open, {picture_size, picture_size}).frame(base_surface()), reference), 0.3);
}

// A Lambert surface's irradiance under a white sky, as a share of the unhidden one, by 4000 rays.
double irradiance_by_rays(const Occluders& occluders, const glm::vec3& point) {
  constexpr int rays = 4000;
  int clear = 0;
  for (int i = 0; i < rays; ++i) {
    const double u = (i + 0.5) / rays, azimuth = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
    const glm::vec3 direction(std::sqrt(u) * std::cos(azimuth), std::sqrt(u) * std::sin(azimuth), std::sqrt(1.0 - u));
    clear += occluders.blocked(point + glm::vec3(0, 0, occluders.offset()), direction) ? 0 : 1;
  }
  return static_cast<double>(clear) / rays;
}

// A ball on the floor: what is between vertices and what the components leave out, against rays, at floor
// points that the camera sees.
TEST(GpuVisibility, ABallDarkensTheFloorAsRaysSay) {
  Scene scene = under_white_sky(white_floor());
  scene.meshes.push_back(sphere_mesh({0.1F, 0.0F, 0.4F}, 0.4F, 24));
  fit_bounds(scene);
  TestRenderer renderer(scene, {picture_size, picture_size});
  const Image picture = renderer.frame(base_surface());
  const Image reference = renderer.reference(64).mean;
  const Occluders occluders(scene);
  double squares = 0, reference_squares = 0;
  int count = 0;
  for (int y = 1; y < picture_size; y += 4) {
    for (int x = 1; x < picture_size; x += 2) {
      const glm::vec3 point(2.0F * (static_cast<float>(x) + 0.5F) / picture_size - 1.0F,
                            1.0F - 2.0F * (static_cast<float>(y) + 0.5F) / picture_size, 0.0F);
      if (glm::distance(glm::vec2(point), glm::vec2(0.1F, 0.0F)) < 0.5F) continue;
      const double exact = irradiance_by_rays(occluders, point);
      squares += std::pow(picture.at(x, y)[0] - exact, 2.0);
      reference_squares += std::pow(reference.at(x, y)[0] - exact, 2.0);
      ++count;
    }
  }
  EXPECT_LT(std::sqrt(squares / count), 0.02);
  EXPECT_LT(std::sqrt(reference_squares / count), 0.02);  // with its noise
  EXPECT_LT(relative_rmse(picture, reference), 0.03);
  for (const float value : picture.texels) EXPECT_LE(value, 1.002F);
  scene.shadows.cast = false;
  EXPECT_GT(relative_rmse(TestRenderer(scene, {picture_size, picture_size}).frame(base_surface()), reference), 0.1);
}

// A low sun behind the wall, and little else: the shadow is where the reference has it.
TEST(GpuVisibility, AWallHidesASmallSun) {
  Scene scene = floor_by_a_wall();
  Image map(512, 256, 3, 0.2F);
  Environment environment{.name = "sunny", .radiance = std::make_shared<const Image>(map)};
  const glm::dvec2 at = environment_uv(environment, glm::normalize(glm::dvec3(-1.0, 0.0, 1.0)));
  for (float& channel : map.at(static_cast<int>(at.x * 512), static_cast<int>(at.y * 256))) channel = 4e4F;
  environment.radiance = std::make_shared<const Image>(std::move(map));
  scene.environment = environment;
  TestRenderer renderer(scene, {picture_size, picture_size});
  ASSERT_EQ(renderer.gpu_scene().environment()->sun_count(), 1U);
  const Image picture = renderer.frame(base_surface());
  const Image reference = renderer.reference(64).mean;
  const float lit = picture.at(picture_size - 2, picture_size / 2)[0], hidden = picture.at(4, picture_size / 2)[0];
  EXPECT_LT(hidden, 0.2F * lit);
  EXPECT_LT(relative_rmse(picture, reference), 0.06);
  scene.shadows.cast = false;
  EXPECT_GT(relative_rmse(TestRenderer(scene, {picture_size, picture_size}).frame(base_surface()), reference), 0.5);
}

TEST(GpuVisibility, IsNowhereWhereNothingHidesTheEnvironment) {
  TestRenderer plain(under_white_sky(white_floor()), {picture_size, picture_size});
  EXPECT_FALSE(plain.gpu_scene().visibility());
  EXPECT_FALSE(test::says(plain.fragment_text(base_surface()), "visibility_maps"));
  Scene covered = under_white_sky(box_over_floor());
  TestRenderer hidden(covered, {picture_size, picture_size});
  ASSERT_TRUE(hidden.gpu_scene().visibility());
  EXPECT_FALSE(hidden.gpu_scene().shadow_maps());
  EXPECT_FALSE(test::says(hidden.fragment_text(base_surface()), "shadow_maps"));
  EXPECT_TRUE(test::says(hidden.fragment_text(base_surface()), "visibility_maps"));
  const GpuVisibility& visibility = *hidden.gpu_scene().visibility();
  EXPECT_EQ(visibility.bytes(), visibility.vertex_count() * 80 + std::size_t{4} * 18 * 18 * 16);
  covered.environment.reset();
  covered.lights.emplace_back(DirectionalLight{.direction = {0, 0, -1}, .illuminance = glm::vec3(1.0F)});
  EXPECT_FALSE(TestRenderer(covered, {picture_size, picture_size}).gpu_scene().visibility());
}

TEST(GpuVisibility, IsThatOfTheSameSceneWithOtherEffects) {
  const Scene scene = under_white_sky(box_over_floor());
  const EffectSet effects = effects_on(derive_effects(scene));
  const auto without = [&](Effect effect) { return EffectSet(effects).reset(static_cast<std::size_t>(effect)); };
  const gl::ContextInfo& context = shared_context().info();
  const GpuScene whole(context, scene, effects);
  const auto variant = [&](Effect left_out) {
    return GpuScene(context, scene, without(left_out), no_progress, nullptr, &whole);
  };
  EXPECT_EQ(variant(Effect::fresnel).visibility(), whole.visibility());
  EXPECT_EQ(variant(Effect::fresnel).environment(), whole.environment());
  EXPECT_EQ(variant(Effect::fresnel).shared_bytes(), whole.shared_bytes());
  EXPECT_EQ(variant(Effect::environment_light).environment(), nullptr);
  EXPECT_EQ(variant(Effect::environment_light).visibility(), nullptr);
}

// Shorter edges are for the vertices' values alone.
TEST(GpuVisibility, RefiningChangesNoPicture) {
  const Scene scene = under_white_sky(box_over_floor());
  EffectSet effects = effects_on(derive_effects(scene));
  const Scene fine = refined_for_visibility(scene, effects);
  EXPECT_GT(fine.meshes[0].vertices.size(), 10 * scene.meshes[0].vertices.size());
  effects.reset(static_cast<std::size_t>(Effect::cast_shadow));
  EXPECT_EQ(refined_for_visibility(scene, effects).meshes[0].vertices.size(), scene.meshes[0].vertices.size());
  EXPECT_LT(largest_difference(TestRenderer(fine, {picture_size, picture_size}, effects).frame(base_surface()),
                               TestRenderer(scene, {picture_size, picture_size}, effects).frame(base_surface())),
            1e-4);
}

// What moves takes its shadow along.
TEST(GpuVisibility, FollowsAnUpdate) {
  Scene scene = under_white_sky(box_over_floor());
  const Scene fine = refined_for_visibility(scene, effects_on(derive_effects(scene)));
  TestRenderer renderer(fine, {picture_size, picture_size});
  const Image before = renderer.frame(base_surface());
  Scene moved = fine;
  for (Vertex& vertex : moved.meshes[1].vertices) vertex.position.x += 0.4F;
  renderer.update(moved);
  const Image after = renderer.frame(base_surface());
  EXPECT_GT(largest_difference(before, after), 0.1);
  EXPECT_LT(largest_difference(after, TestRenderer(moved, {picture_size, picture_size}).frame(base_surface())), 1e-5);
}

}  // namespace
}  // namespace footprint::testing
