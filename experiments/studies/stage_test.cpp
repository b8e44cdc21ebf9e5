// In which order a stage makes its methods, and in which it has them.
#include "experiments/studies/stage.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/test_scenes.hpp"

namespace footprint {
namespace {

// tan_gmm takes much while it bakes, and would take it beside what all others keep.
TEST(Stage, BakesFirstWhatTakesTheMostAndHasMethodsAsTheyWereNamed) {
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
  EXPECT_EQ(baked, (std::vector<std::string>{"bake tan_gmm:n=2", "bake toksvig", "bake direct"}));
  ASSERT_EQ(stage.methods().size(), 3U);
  EXPECT_EQ(stage.methods()[0].baked().spec.text, "direct");
  EXPECT_EQ(stage.methods()[1].baked().spec.text, "toksvig");
  EXPECT_EQ(stage.methods()[2].baked().spec.text, "tan_gmm:n=2");
}

}  // namespace
}  // namespace footprint
