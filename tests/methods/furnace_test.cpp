// White furnace: under light from all sides every method keeps the energy of the reference within the bound that its
// README states.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <numbers>
#include <regex>

#include "methods/registry.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/source_folder.hpp"
#include "tests/support/sweep.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing {
namespace {

// The README's "White furnace: within X%", as a share; NaN where it has no such words.
double stated_bound(const std::string& method) {
  std::ifstream file(source_folder() / "methods" / method / "README.md");
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  std::smatch found;
  if (!std::regex_search(text, found, std::regex(R"(White furnace: within ([0-9.]+)%)"))) return std::nan("");
  return std::stod(found[1].str()) / 100.0;
}

// Texels that lean up to 30 degrees, lit by 1 from everywhere.
Scene furnace(const SquareMaterial& material, float light = 1.0F) {
  Scene scene = square_scene(random_normals(16, 16, 0.5F, 7), material);
  scene.lights.clear();
  scene.environment = constant_environment(glm::vec3(light));
  return scene;
}

// The furnace's renderer, which methods share.
TestRenderer& furnace_renderer(const SquareMaterial& material) {
  return shared_renderer(fmt::format("furnace {} {}", material.roughness, material.brdf.diffuse),
                         [&] { return furnace(material); }, {32, 32});
}

// White Lambert, and white metals of alpha 1/16, 1/4 and 1/2.
std::vector<SquareMaterial> white_materials() {
  constexpr BaseBrdf diffuse_only{NormalDistribution::ggx, GeometryTerm::none, FresnelTerm::none, true};
  constexpr BaseBrdf metal{NormalDistribution::ggx, GeometryTerm::smith, FresnelTerm::none, false};
  std::vector<SquareMaterial> materials{
      {.brdf = diffuse_only, .base_color = glm::vec3(1.0F), .specular = glm::vec3(0.0F)}};
  for (const float alpha : {0.0625F, 0.25F, 0.5F})
    materials.push_back({.brdf = metal, .roughness = std::sqrt(alpha), .specular = glm::vec3(1.0F)});
  return materials;
}

// The gate: energy off by no more than the bound, and no pixel brighter than the furnace by more than a tenth.
::testing::AssertionResult keeps_energy(const Image& picture, double expected, double bound) {
  const double ratio = covered_mean(picture) / expected;
  if (!(std::abs(ratio - 1.0) <= bound)) {
    return ::testing::AssertionFailure() << "energy " << ratio << " of the reference's, bound " << bound;
  }
  for (const float value : picture.texels) {
    if (!(value <= 1.1F)) return ::testing::AssertionFailure() << "a pixel of " << value;
  }
  return ::testing::AssertionSuccess() << ratio;
}

class InAWhiteFurnace : public ::testing::TestWithParam<const Method*> {};

TEST_P(InAWhiteFurnace, KeepsItsEnergyWithinTheBoundOfItsReadme) {
  const std::string& name = GetParam()->info.name;
  if (!has(GetParam()->info.honours, Effect::environment_light)) GTEST_SKIP() << "leaves environment light out";
  const double bound = stated_bound(name);
  ASSERT_TRUE(std::isfinite(bound)) << "methods/" << name << "/README.md has no `White furnace: within X%`";
  for (const SquareMaterial& material : white_materials()) {
    TestRenderer& renderer = furnace_renderer(material);
    static std::map<TestRenderer*, double> references;  // the same for all methods
    const auto [reference, is_new] = references.try_emplace(&renderer, 0.0);
    if (is_new) reference->second = covered_mean(renderer.reference(36).mean);
    for (const double distance : {0.5, 4.0}) {
      EXPECT_TRUE(keeps_energy(renderer.frame(*GetParam(), {}, {}, 0, distance), reference->second, bound))
          << name << ", roughness " << material.roughness << ", diffuse " << material.brdf.diffuse << ", distance "
          << distance;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Registry, InAWhiteFurnace, ::testing::ValuesIn(all_methods().begin(), all_methods().end()),
                         [](const auto& test) { return test.param->info.name; });

// Where the horizon is open every facet has a hemisphere of its own: white Lambert facets reflect all of the furnace,
// however they lean. Where it cuts they lose (1 - n_z) / 2.
TEST(AnOpenHorizon, LosesNothingInAWhiteFurnace) {
  Scene scene = furnace(white_materials().front());
  const double cut = covered_mean(furnace_renderer(white_materials().front()).reference(36).mean);
  scene.horizon = Horizon::open;
  TestRenderer renderer(scene, {32, 32});
  const Image normals = scene.materials[0].normal_map->image.decoded();
  double seen = 0.0;
  for (std::size_t i = 2; i < normals.texels.size(); i += 4) seen += 0.5 + 0.5 * normals.texels[i];
  EXPECT_NEAR(cut, seen / static_cast<double>(normals.texel_count()), 3e-3);
  EXPECT_LT(cut, 0.99);
  EXPECT_NEAR(covered_mean(renderer.reference(36).mean), 1.0, 2e-3);
  for (const char* const method : {"direct", "toksvig", "lean"}) {
    EXPECT_NEAR(covered_mean(renderer.frame(find_method(method))), 1.0, 0.02) << method;
  }
  EXPECT_NEAR(covered_mean(renderer.supersampled(find_method("direct"), 36).mean), 1.0, 1e-3);
}

// A level map has one horizon, whoever asks.
TEST(AnOpenHorizon, IsThatOfALevelSurface) {
  for (const SquareMaterial& material : sweep(white_materials(), 2)) {
    Scene scene = furnace(material);
    scene.materials[0].normal_map.reset();
    TestRenderer cut(scene, {32, 32});
    scene.horizon = Horizon::open;
    TestRenderer open(scene, {32, 32});
    EXPECT_LT(largest_difference(cut.frame(find_method("direct")), open.frame(find_method("direct"))), 1e-5);
    EXPECT_NEAR(covered_mean(cut.reference(36).mean) / covered_mean(open.reference(36).mean), 1.0, 2e-3);
  }
}

// The mean of a frame under one light per direction of the upper hemisphere, as much as the furnace's together.
double under_lights(const Method& method, const SquareMaterial& material, double distance) {
  constexpr int lights = 1024, at_once = 512;
  double sum = 0.0;
  for (int first = 0; first < lights; first += at_once) {
    Scene scene = furnace(material);
    scene.environment.reset();
    for (int i = first; i < first + at_once; ++i) {
      const double z = (i + 0.5) / lights, azimuth = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
      const double r = std::sqrt(1.0 - z * z);
      scene.lights.emplace_back(
          DirectionalLight{.direction = -glm::vec3(r * std::cos(azimuth), r * std::sin(azimuth), z),
                           .illuminance = glm::vec3(2.0F * std::numbers::pi_v<float> / lights)});
    }
    sum += covered_mean(TestRenderer(scene, {32, 32}).frame(method, {}, {}, 0, distance));
  }
  return sum;
}

// Methods look up the light that their own BRDFs reflect of an environment, masking and horizon included.
TEST(AWhiteFurnace, IsTheSumOfItsLights) {
  for (const char* const name : {"direct", "toksvig", "cells"}) {
    const Method& method = find_method(name);
    for (const std::size_t metal : {2U, 3U}) {  // a narrower lobe would need more lights
      const SquareMaterial material = white_materials().at(metal);
      const double looked_up = covered_mean(furnace_renderer(material).frame(method, {}, {}, 0, 4.0));
      EXPECT_NEAR(looked_up / under_lights(method, material, 4.0), 1.0, 0.01) << name << ", " << material.roughness;
    }
  }
}

// The gate closes: on a picture that is as much too bright as the widest bound allows and some more, on one with a
// single bright pixel, and on one that is not finite.
TEST(InAWhiteFurnaceGate, RefusesWhatGainsOrLosesEnergy) {
  const SquareMaterial plaster = white_materials().front();
  const Method& direct = find_method("direct");
  const double reference = covered_mean(furnace_renderer(plaster).reference(36).mean);
  const double bound = stated_bound("direct");
  const Image unchanged = furnace_renderer(plaster).frame(direct);
  EXPECT_TRUE(keeps_energy(unchanged, reference, bound));
  EXPECT_FALSE(keeps_energy(TestRenderer(furnace(plaster, 1.3F), {32, 32}).frame(direct), reference, bound));
  EXPECT_FALSE(keeps_energy(TestRenderer(furnace(plaster, 0.7F), {32, 32}).frame(direct), reference, bound));
  for (const float value : {1.2F, std::nanf("")}) {
    Image spoilt = unchanged;
    spoilt.at(4, 3)[0] = value;
    EXPECT_FALSE(keeps_energy(spoilt, reference, bound)) << value;
  }
}

}  // namespace
}  // namespace footprint::testing
