// In which order a stage makes its methods, and in which it has them.
#include "experiments/studies/stage.hpp"
#include "experiments/studies/view_path.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/image/metrics.hpp"
#include "tests/support/gltf_builder.hpp"
#include "tests/support/shadow_scenes.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint {
namespace {

TEST(Stage, BakesMethodsInTheirOrder) {
  RunSettings settings;
  settings.methods = parse_methods("direct,toksvig,tan_gmm:n=2");
  settings.view.size = {16, 16};
  settings.cache.reset();
  std::vector<std::string> baked;
  const Progress watch = [&](std::string_view what, double /*fraction*/) {
    const std::string method(what.substr(0, what.find(": material")));
    if (what.starts_with("bake ") && what.ends_with(": material") && method != "bake reference")
      baked.push_back(method);
  };
  Scene scene = testing::square_scene(testing::random_normals(16, 16, 0.5F, 1), {});
  scene.materials.front().name = "material";
  const Stage stage(std::move(scene), settings, watch);
  EXPECT_EQ(baked, (std::vector<std::string>{"bake direct", "bake toksvig", "bake tan_gmm:n=2"}));
  ASSERT_EQ(stage.methods().size(), 3U);
  EXPECT_EQ(stage.methods()[0].baked().spec.text, "direct");
  EXPECT_EQ(stage.methods()[1].baked().spec.text, "toksvig");
  EXPECT_EQ(stage.methods()[2].baked().spec.text, "tan_gmm:n=2");
}

TEST(Stage, InfoCountsTheTrianglesThatTheSceneHasAndNotTheirPartsForVisibility) {
  Scene scene = testing::box_over_floor();
  scene.environment = constant_environment(glm::vec3(1.0F));
  std::size_t given = 0;
  for (const Mesh& mesh : scene.meshes) given += mesh.indices.size() / 3;
  RunSettings settings;
  settings.view.size = {8, 8};
  settings.cache.reset();
  const Stage stage(std::move(scene), settings, no_progress);
  EXPECT_GT(stage.scene().meshes.front().indices.size() / 3, given);
  EXPECT_EQ(stage.info().triangles, given);
}

TEST(Stage, TakesFromAPreparedSceneWhatAnotherStageBakedAndDrawsTheSame) {
  const auto scene = [] { return testing::square_scene(testing::random_normals(16, 16, 0.5F, 1), {}); };
  RunSettings settings;
  settings.methods = parse_methods("direct,toksvig");
  settings.view.size = {16, 16};
  settings.cache.reset();
  std::size_t bakes = 0;
  const Progress watch = [&](std::string_view what, double /*fraction*/) {
    bakes += what.starts_with("bake ") ? 1 : 0;
  };
  const auto prepared = std::make_shared<PreparedScene>(scene(), settings);
  const Stage first(prepared, settings, watch);
  EXPECT_GT(bakes, 0U);
  bakes = 0;
  settings.view.size = {24, 24};
  settings.footprint = FootprintFilter{FootprintFilterKind::box, 2};
  const Stage second(prepared, settings, watch);
  EXPECT_EQ(bakes, 0U);
  const auto pictures = [](const Stage& stage) {
    std::vector<std::vector<float>> all;
    for (const StagedMethod& method : stage.methods()) all.push_back(method.frames().render(stage.view(1.0)).texels);
    return all;
  };
  const auto shared = pictures(second);  // before another context is made
  for (const std::size_t method : {0U, 1U})
    EXPECT_EQ(&second.methods()[method].baked(), &first.methods()[method].baked());
  EXPECT_EQ(shared, pictures(Stage(scene(), settings, no_progress)));
}

// A leaf that turns about the edge of a quad, under the supplied lights and the environment that it hides a part of.
std::string turning_leaf() {
  test::GltfBuilder file = test::make_quad();
  const int input = file.add_floats({0, 2}, "SCALAR");
  const int output = file.add_floats({0, 0, 0, 1, 0, 0.5F, 0, 0.8660254F}, "VEC4");
  file.json["nodes"].push_back({{"mesh", 0}, {"translation", {-1, 0, 0.3}}, {"children", {2}}});
  file.json["nodes"].push_back({{"mesh", 0}, {"translation", {1, 0, 0.2}}});
  file.json["scenes"] = {{{"nodes", {0, 1}}}};
  file.json["scene"] = 0;
  file.json["animations"] = {{{"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "rotation"}}}}}},
                              {"samplers", {{{"input", input}, {"output", output}}}}}};
  return file.write().string();
}

TEST(Stage, AFrameOfAnAnimationIsThatOfTheScenePosedAtItsTime) {
  RunSettings settings;
  settings.scene = turning_leaf();
  settings.methods = parse_methods("direct");
  settings.view.size = {24, 24};
  settings.view.zoom.frames = 3;
  settings.view.path.kind = AnimationPath::animation;
  settings.cache.reset();
  ScenePoses poses(settings.scene, settings.scene_library, settings.overrides);
  const Scene scene = scene_of_run(settings.view, poses);
  const std::vector<PlannedView> views = plan_views(settings.view, poses.first_time(), scene);
  const auto moved = [&](const std::vector<std::size_t>& frames) {
    Stage stage(scene, settings, no_progress);
    View view;
    for (const std::size_t frame : frames) view = stage.move_to(views[frame].at);
    return stage.methods().front().frames().render(view).texels;
  };
  const auto posed = [&](double seconds) {
    const Stage stage(poses.at(seconds, PlacedBounds{scene.bounds, scene.origin}), settings, no_progress);
    return stage.methods().front().frames().render(stage.view(1.0)).texels;
  };
  const std::vector<float> first = posed(0.0);
  EXPECT_EQ(moved({2, 0}), first);
  EXPECT_NE(posed(2.0), first);
}

// An image that is not finite, or memory that is not there, is the method's own failure; an interrupt is not.
TEST(Stage, FailuresOfAMethodAreNamedAndInterruptsPass) {
  const gl::Context context(gl::ContextRequest{});
  const MethodSpec spec = parse_methods("toksvig:storage=fp16").front();
  const auto nan = std::numeric_limits<float>::quiet_NaN();
  Image reference(1, 1, 4), picture(1, 1, 4);
  reference.texels = {1, 1, 1, 1};
  picture.texels = {1, nan, 1, 1};
  const auto failure = catch_failure(context, spec, [&] { (void)normalized_color(picture, reference, 1.0F); });
  ASSERT_TRUE(failure.has_value());
  EXPECT_THAT(failure->what(), ::testing::HasSubstr("method toksvig:storage=fp16"));
  EXPECT_THAT(failure->what(), ::testing::HasSubstr("pixel (0, 0): the value is not a finite number"));
  const auto memory = catch_failure(context, spec, [] { throw std::bad_alloc(); });
  ASSERT_TRUE(memory.has_value());
  EXPECT_THAT(memory->what(), ::testing::HasSubstr("method toksvig:storage=fp16: out of memory"));
  EXPECT_FALSE(catch_failure(context, spec, [] {}).has_value());
  EXPECT_THROW((void)catch_failure(context, spec, [] { throw Error(ErrorKind::interrupted, "", "interrupted"); }),
               Error);
}

}  // namespace
}  // namespace footprint
