// One small frame of every method: the shortest proof that each bakes, compiles and draws.
#include <gtest/gtest.h>

#include "methods/registry.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing {
namespace {

class SmallFrame : public ::testing::TestWithParam<const Method*> {};

TEST_P(SmallFrame, HasTheBrightnessOfTheReference) {
  TestRenderer& renderer =
      shared_renderer("bumps", [] { return square_scene(random_normals(16, 16, 0.5F, 5), {}); }, {32, 32});
  static const double reference = covered_mean(renderer.reference(64).mean);  // the same for all methods
  EXPECT_NEAR(covered_mean(renderer.frame(*GetParam())) / reference, 1.0, 0.15);
}

INSTANTIATE_TEST_SUITE_P(Registry, SmallFrame, ::testing::ValuesIn(all_methods().begin(), all_methods().end()),
                         [](const auto& test) { return test.param->info.name; });

}  // namespace
}  // namespace footprint::testing
