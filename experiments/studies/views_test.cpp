// The positions of camera and lights along a path, on a scene without a file.
#include "experiments/studies/stage.hpp"
#include "experiments/studies/view_path.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <glm/gtc/matrix_transform.hpp>
#include <string>

#include "renderer/core/error.hpp"
#include "renderer/scene/assembly/load_scene.hpp"
#include "tests/support/gltf_builder.hpp"

namespace footprint {
namespace {

// A camera at z = 5 that looks at a box around (0, 0, 1).
Scene looked_at() {
  Scene scene;
  scene.source = "made up";
  scene.bounds = {.lower = glm::vec3(-1, -1, 0), .upper = glm::vec3(1, 1, 2)};
  scene.camera.world = glm::translate(glm::mat4(1.0F), glm::vec3(0, 0, 5));
  return scene;
}

RunSettings path_of(AnimationPath kind, int frames) {
  RunSettings run;
  run.view.path.kind = kind;
  run.view.zoom.frames = frames;
  return run;
}

ScenePoses poses_of(const RunSettings& run) { return {run.scene, run.scene_library, run.overrides}; }

std::vector<PlannedView> planned(const RunSettings& run, const Scene& scene) {
  return plan_views(run.view, poses_of(run).first_time(), scene);
}

std::string refusal(const RunSettings& run, const Scene& scene) {
  try {
    (void)planned(run, scene);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

// Files and messages of different views have different names.
TEST(RunViews, AreCalledByTheirKind) {
  RunSettings run;
  run.view.distances = {1.0, 2.5};
  const std::vector<PlannedView> distances = planned(run, looked_at());
  EXPECT_EQ(distances[1].words(), "distance 2.5");
  EXPECT_EQ(distances[1].stem("lean"), "d2.5_lean");
  EXPECT_EQ(distances[1].at.frame, 0U);
  const std::vector<PlannedView> frames = planned(path_of(AnimationPath::orbit, 3), looked_at());
  EXPECT_EQ(frames[1].words(), "frame 2 of 3");
  EXPECT_EQ(frames[1].stem("lean"), "lean_0001");
  EXPECT_EQ(frames[1].at.frame, 1U);
  run.view.zoom = {.frames = 3, .from = 1.0, .to = 4.0};
  const std::vector<PlannedView> zoom = planned(run, looked_at());
  EXPECT_EQ(zoom[1].kind, RunKind::zoom);
  EXPECT_EQ(zoom[1].stem("lean"), "d2_lean");
  EXPECT_EQ(zoom[1].at.frame, 1U);
}

TEST(RunViews, AnOrbitKeepsItsDistanceAndLooksAtTheCentre) {
  RunSettings run = path_of(AnimationPath::orbit, 3);
  run.view.path.degrees = 90;
  run.view.distances = {2.0};
  const Scene scene = looked_at();
  const std::vector<PlannedView> frames = planned(run, scene);
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_EQ(frames[0].at.degrees, 0.0);
  EXPECT_EQ(frames[2].at.degrees, 90.0);
  const Camera last = camera_on_path(run.view.path, scene, frames[2].at);
  EXPECT_NEAR(glm::length(glm::vec3(last.world[3]) - glm::vec3(8, 0, 1)), 0.0F, 1e-5F);
  EXPECT_NEAR(glm::length(glm::vec3(last.world[2]) - glm::vec3(1, 0, 0)), 0.0F, 1e-6F);
  EXPECT_EQ(camera_on_path(run.view.path, scene, frames[0].at), camera_at_distance(scene, 2.0));
}

TEST(RunViews, LightsTurnTogetherAndTheCameraStays) {
  RunSettings run = path_of(AnimationPath::light, 2);
  run.view.path.degrees = 180;
  run.view.path.axis = glm::dvec3(0, 0, 1);
  Scene scene = looked_at();
  scene.lights = {PointLight{.position = glm::vec3(3, 0, 7), .range = {}},
                  DirectionalLight{.direction = glm::vec3(0.6F, 0, -0.8F)}};
  const std::vector<PlannedView> frames = planned(run, scene);
  const std::vector<Light> lights = lights_on_path(run.view.path, scene, scene.lights, frames[1].at);
  EXPECT_NEAR(glm::length(std::get<PointLight>(lights[0]).position - glm::vec3(-3, 0, 7)), 0.0F, 1e-5F);
  EXPECT_NEAR(glm::length(std::get<DirectionalLight>(lights[1]).direction - glm::vec3(-0.6F, 0, -0.8F)), 0.0F, 1e-6F);
  EXPECT_EQ(camera_on_path(run.view.path, scene, frames[1].at), camera_at_distance(scene, 1.0));
}

TEST(RunViews, AZoomIsThatOfAnExperiment) {
  RunSettings run = path_of(AnimationPath::zoom, 3);
  run.view.zoom.from = 1;
  run.view.zoom.to = 4;
  const std::vector<PlannedView> frames = planned(run, looked_at());
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_EQ(frames[1].at.distance, 2.0);
  EXPECT_EQ(lights_on_path(run.view.path, looked_at(), {}, frames[2].at).size(), 0U);
}

// The quad moves by 6 m along x until 3 s.
std::string moving_quad() {
  test::GltfBuilder file = test::make_quad();
  const int input = file.add_floats({0, 3}, "SCALAR"), output = file.add_floats({0, 0, 0, 6, 0, 0}, "VEC3");
  file.json["animations"] = {{{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}},
                              {"samplers", {{{"input", input}, {"output", output}}}}}};
  return file.write().string();
}

TEST(RunViews, AnAnimationHasEqualTimesUntilItsLastKeyWithinTheBoundsOfAllFrames) {
  RunSettings run = path_of(AnimationPath::animation, 4);
  run.scene = moving_quad();
  ScenePoses poses = poses_of(run);
  const Scene scene = scene_of_run(run.view, poses);
  const std::vector<PlannedView> frames = planned(run, scene);
  ASSERT_EQ(frames.size(), 4U);
  EXPECT_EQ(frames[0].at.seconds, 0.0);
  EXPECT_EQ(frames[1].at.seconds, 1.0);
  EXPECT_EQ(frames[3].at.seconds, 3.0);
  EXPECT_EQ(scene.bounds.lower.x, -1.0F);
  EXPECT_EQ(scene.bounds.upper.x, 7.0F);
  const Scene later = poses.at(1.0, PlacedBounds{scene.bounds, scene.origin});
  EXPECT_EQ(later.meshes.front().vertices.front().position.x, scene.meshes.front().vertices.front().position.x + 2.0F);
  EXPECT_EQ(later.camera, scene.camera) << "framed on all frames";
  run.overrides.model.time = 1.0;
  run.view.path.until = 1.5;
  const std::vector<PlannedView> part = planned(run, scene_of_run(run.view, poses));
  EXPECT_EQ(part[0].at.seconds, 1.0);
  EXPECT_EQ(part[3].at.seconds, 1.5);
}

// A file that is gone after the first frame, as of a model on a share.
TEST(RunViews, AnAnimationReadsItsFilesOnce) {
  RunSettings run = path_of(AnimationPath::animation, 4);
  run.scene = moving_quad();
  ScenePoses poses = poses_of(run), others = poses_of(run);
  const Scene scene = scene_of_run(run.view, poses);
  const Scene expected = others.at(2.0, PlacedBounds{scene.bounds, scene.origin});
  std::filesystem::remove(run.scene);
  const Scene later = poses.at(2.0, PlacedBounds{scene.bounds, scene.origin});
  EXPECT_EQ(later.meshes.front().vertices.front().position, expected.meshes.front().vertices.front().position);
  EXPECT_EQ(later.materials.size(), expected.materials.size());
  EXPECT_EQ(later.warnings, expected.warnings);
}

// A quad that comes to 1 m above another one, under light from straight above.
TEST(RunViews, AnAnimationCastsShadowsIfAnyOfItsFramesDoes) {
  test::GltfBuilder file = test::make_quad();
  const int input = file.add_floats({0, 1}, "SCALAR"), output = file.add_floats({10, 0, 1, 0, 0, 1}, "VEC3");
  file.json["nodes"].push_back({{"mesh", 0}});
  file.json["nodes"].push_back({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  file.json["scenes"] = {{{"nodes", {0, 1, 2}}}};
  file.json["scene"] = 0;
  file.json["extensionsUsed"] = {"KHR_lights_punctual"};
  file.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "directional"}}};
  file.json["animations"] = {{{"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}}}},
                              {"samplers", {{{"input", input}, {"output", output}}}}}};
  RunSettings run = path_of(AnimationPath::animation, 2);
  run.scene = file.write().string();
  ScenePoses poses = poses_of(run);
  EXPECT_EQ(scene_of_run(run.view, poses).shadows.cast, true);
  run.view.path.until = 0.1;  // 9 m beside it
  EXPECT_FALSE(scene_of_run(run.view, poses).shadows.cast.has_value());
}

TEST(RunViews, WhatAPathHasNoUseForIsRefused) {
  RunSettings zoom = path_of(AnimationPath::zoom, 2);
  zoom.view.path.degrees = 5;
  EXPECT_NE(refusal(zoom, looked_at()).find("--degrees: this path does not turn"), std::string::npos);
  RunSettings orbit = path_of(AnimationPath::orbit, 2);
  orbit.view.zoom.to = 5;
  EXPECT_NE(refusal(orbit, looked_at()).find("--to: this path is not a zoom"), std::string::npos);
  EXPECT_NE(refusal(path_of(AnimationPath::light, 2), looked_at()).find("no light to move"), std::string::npos);
  RunSettings animation = path_of(AnimationPath::animation, 2);
  EXPECT_NE(refusal(animation, looked_at()).find("--until: the animation ends at 0 s"), std::string::npos);
  animation.view.path.axis = glm::dvec3(0, 0, 1);
  EXPECT_NE(refusal(animation, looked_at()).find("--axis: this path does not turn"), std::string::npos);
  orbit = path_of(AnimationPath::orbit, 2);
  orbit.view.path.until = 2;
  EXPECT_NE(refusal(orbit, looked_at()).find("--until: this path follows no animation"), std::string::npos);
}

// A plate before a plate: the light beside them casts no shadow until it has turned in front.
TEST(RunViews, ShadowsCountWhereAnyFrameCallsForThem) {
  Scene scene = looked_at();
  scene.materials.resize(1);
  const auto plate = [](float half, float z) {
    Mesh mesh;
    for (const auto& [x, y] : {std::pair(-1, -1), std::pair(1, -1), std::pair(1, 1), std::pair(-1, 1)})
      mesh.vertices.push_back({.position = glm::vec3(half * static_cast<float>(x), half * static_cast<float>(y), z)});
    mesh.indices = {0, 1, 2, 0, 2, 3};
    return mesh;
  };
  scene.meshes = {plate(1.0F, 0.0F), plate(0.3F, 1.0F)};
  scene.lights = {DirectionalLight{.direction = glm::vec3(0, 0, 1)}};  // from behind
  RunSettings run = path_of(AnimationPath::light, 3);
  run.view.path.axis = glm::dvec3(0, 1, 0);
  run.view.path.degrees = 20;  // still from behind
  EXPECT_FALSE(scene_for_path(run.view, scene).shadows.cast.has_value());
  run.view.path.degrees = 180;
  EXPECT_EQ(scene_for_path(run.view, scene).shadows.cast, true);
  scene.shadows.cast = false;
  EXPECT_EQ(scene_for_path(run.view, scene).shadows.cast, false) << "the scene's own setting has priority";
}

}  // namespace
}  // namespace footprint
