// Framing, zoom and the supplied light rig.
#include "renderer/scene/camera.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/core/error.hpp"
#include "renderer/scene/assembly/load_scene.hpp"

namespace footprint {
namespace {

glm::vec3 in_camera(const Camera& camera, const glm::vec3& point) {
  return glm::vec3{glm::inverse(camera.world) * glm::vec4{point, 1.0F}};
}

/// The largest |x| or |y| of the bounds' corners in the frame, 1 at its edge.
float largest_frame_coordinate(const Camera& camera, const Bounds& bounds, float aspect) {
  float largest = 0.0F;
  const float tan_y = std::tan(camera.yfov / 2.0F);
  for (int i = 0; i < 8; ++i) {
    const glm::vec3 corner{(i & 1) != 0 ? bounds.upper.x : bounds.lower.x,
                           (i & 2) != 0 ? bounds.upper.y : bounds.lower.y,
                           (i & 4) != 0 ? bounds.upper.z : bounds.lower.z};
    const glm::vec3 seen = in_camera(camera, corner);
    EXPECT_LT(seen.z, -camera.znear);
    EXPECT_GT(seen.z, -camera.zfar.value_or(1e30F));
    largest = std::max({largest, std::abs(seen.x / seen.z) / (tan_y * aspect), std::abs(seen.y / seen.z) / tan_y});
  }
  return largest;
}

TEST(Camera, FramedBoundsFillTheFrame) {
  const Bounds bounds{{-3.0F, 1.0F, -1.0F}, {5.0F, 2.0F, 4.0F}};
  for (const float aspect : {0.5F, 1.0F, 2.0F}) {
    const Camera tight = frame_bounds(bounds, {{1.0, 2.0, 3.0}, 0.7, 1.0, aspect});
    EXPECT_NEAR(largest_frame_coordinate(tight, bounds, aspect), 1.0F, 1e-4F);
    const Camera loose = frame_bounds(bounds, {{1.0, 2.0, 3.0}, 0.7, 1.5, aspect});
    EXPECT_LT(largest_frame_coordinate(loose, bounds, aspect), 0.9F);
  }
}

TEST(Camera, FramedBoundsCentreIsOnTheAxis) {
  const Bounds bounds{{10.0F, 0.0F, 0.0F}, {12.0F, 2.0F, 2.0F}};
  for (const glm::dvec3& direction : {glm::dvec3{0, 1, 0}, glm::dvec3{0, -1, 0}, glm::dvec3{1, 0, 0}}) {
    const Camera camera = frame_bounds(bounds, {direction, 0.6, 1.05, 1.0});
    const glm::vec3 centre = in_camera(camera, bounds.centre());
    EXPECT_NEAR(centre.x, 0.0F, 1e-4F);
    EXPECT_NEAR(centre.y, 0.0F, 1e-4F);
    EXPECT_LT(centre.z, 0.0F);
    EXPECT_NEAR(glm::determinant(glm::mat3{camera.world}), 1.0F, 1e-5F);
  }
}

TEST(Camera, BoundsWithoutExtentCanBeFramed) {
  const Camera camera = frame_bounds({glm::vec3{2.0F}, glm::vec3{2.0F}}, {});
  EXPECT_TRUE(std::isfinite(camera.world[3].x));
  EXPECT_GT(camera.znear, 0.0F);
  EXPECT_LT(in_camera(camera, glm::vec3{2.0F}).z, -0.5F);
}

Scene scene_seen_from(float z) {
  Scene scene;
  scene.bounds = {glm::vec3{-1.0F}, glm::vec3{1.0F}};
  scene.camera.world[3] = glm::vec4{0.5F, 0.0F, z, 1.0F};
  scene.camera.znear = 1.0F;
  scene.camera.zfar = 10.0F;
  return scene;
}

TEST(Camera, DistanceScalesTheDepthOfTheCentre) {
  const Scene scene = scene_seen_from(4.0F);
  for (const double factor : {0.5, 1.0, 2.0, 64.0}) {
    const Camera camera = camera_at_distance(scene, factor);
    EXPECT_NEAR(camera.world[3].z, 4.0 * factor, 1e-4 * factor);
    EXPECT_EQ(camera.world[3].x, 0.5F);
    EXPECT_GT(camera.znear, 0.0F);
    EXPECT_GT(*camera.zfar, camera.znear);
  }
  EXPECT_EQ(camera_at_distance(scene, 1.0).znear, 1.0F);
  EXPECT_NEAR(camera_at_distance(scene, 2.0).znear, 5.0F, 1e-5F);  // the plane stays at z = 3 in the world
  EXPECT_NEAR(*camera_at_distance(scene, 2.0).zfar, 14.0F, 1e-5F);
  EXPECT_NEAR(camera_at_distance(scene, 0.5).znear, 0.5F, 1e-5F);
}

TEST(Camera, DistanceOfAnOrthographicCameraIsItsSize) {
  Scene scene = scene_seen_from(4.0F);
  scene.camera.orthographic = true;
  scene.camera.ymag = 3.0F;
  const Camera camera = camera_at_distance(scene, 2.0);
  EXPECT_EQ(camera.ymag, 6.0F);
  EXPECT_EQ(camera.world, scene.camera.world);
}

TEST(Camera, DistanceFromWithinOrBehindStaysFinite) {
  for (const float z : {0.0F, -5.0F}) {
    const Camera camera = camera_at_distance(scene_seen_from(z), 3.0);
    EXPECT_GT(camera.world[3].z, z);
  }
}

TEST(Camera, DistanceMustBePositive) {
  for (const double factor : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    EXPECT_THROW((void)camera_at_distance(scene_seen_from(4.0F), factor), Error);
  }
}

// What the header says of white Lambert, by a plain sum over the sphere; and that it is neutral and nowhere black.
TEST(LightRig, SuppliedEnvironmentIsAsBrightAsItSays) {
  const Environment studio = supplied_environment();
  const Image& map = *studio.radiance;
  const std::vector<double> solid_angles = row_solid_angles(map.width, map.height);
  for (const glm::dvec3& normal : {glm::dvec3(0, 1, 0), {0, -1, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 0, 0}, {0, 0, -1}}) {
    double radiance = 0;
    for (int y = 0; y < map.height; ++y) {
      for (int x = 0; x < map.width; ++x) {
        const glm::dvec3 direction = environment_direction(studio, (x + 0.5) / map.width, (y + 0.5) / map.height);
        radiance += std::max(glm::dot(direction, normal), 0.0) * solid_angles[static_cast<std::size_t>(y)] *
                    map.at(x, y)[1] / std::numbers::pi;
      }
    }
    EXPECT_GT(radiance, 0.1);
    EXPECT_LT(radiance, 0.5);
  }
  for (std::size_t i = 0; i < map.texels.size(); i += 3) {
    ASSERT_GE(map.texels[i], 0.05F);
    ASSERT_LE(map.texels[i], 1.5F);
    ASSERT_EQ(map.texels[i], map.texels[i + 2]);
  }
}

TEST(LightRig, WhiteSurfaceFacingTheCameraHasItsRadiance) {
  const Bounds bounds{{-1.0F, -2.0F, 3.0F}, {5.0F, 2.0F, 4.0F}};
  const Camera camera = frame_bounds(bounds, {{0.3, 0.9, -0.5}, 0.6, 1.1, 1.0});
  const glm::vec3 normal{camera.world[2]};
  float radiance = 0.0F;
  for (const Light& light : supplied_lights(camera, bounds)) {
    if (const auto* sun = std::get_if<DirectionalLight>(&light)) {
      radiance += sun->illuminance.g * std::max(0.0F, glm::dot(normal, -sun->direction)) / std::numbers::pi_v<float>;
      EXPECT_NEAR(glm::length(sun->direction), 1.0F, 1e-5F);
    } else {
      const auto& point = std::get<PointLight>(light);
      const glm::vec3 way = point.position - bounds.centre();
      radiance +=
          point.intensity.g / glm::dot(way, way) * glm::dot(normal, glm::normalize(way)) / std::numbers::pi_v<float>;
    }
  }
  EXPECT_NEAR(radiance, 0.8F, 1e-4F);
}

}  // namespace
}  // namespace footprint
