// `--set KIND.PARAMETER=FROM:TO`: what it means in each frame, and every way to get it wrong.
#include "experiments/studies/edit.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "renderer/core/error.hpp"
#include "renderer/microgeometry/microgeometry.hpp"
#include "tests/support/gltf_builder.hpp"
#include "tests/support/says.hpp"

namespace footprint {
namespace {

using Values = std::map<std::string, std::string>;

TEST(ParameterSweep, GoesFromTheFirstValueToTheLastAtEqualSteps) {
  const std::vector<ParameterSweep> sweeps{parse_sweep("weave.warp_width=0.5:0.1"), parse_sweep("weave.height=0.25"),
                                           parse_sweep("weave.steps_along=4:7")};
  EXPECT_EQ(values_at(sweeps, "weave", 0, 3),
            (Values{{"height", "0.25"}, {"steps_along", "4"}, {"warp_width", "0.5"}}));
  EXPECT_EQ(values_at(sweeps, "weave", 1, 3),
            (Values{{"height", "0.25"}, {"steps_along", "6"}, {"warp_width", "0.3"}}));
  EXPECT_EQ(values_at(sweeps, "weave", 2, 3),
            (Values{{"height", "0.25"}, {"steps_along", "7"}, {"warp_width", "0.1"}}));
  EXPECT_EQ(values_at(sweeps, "weave", 0, 1).at("warp_width"), "0.5");
  const std::vector<ParameterSweep> word{parse_sweep("grooves.profile=round")};
  EXPECT_EQ(values_at(word, "grooves", 1, 2), (Values{{"profile", "round"}}));
  const std::vector<ParameterSweep> both{parse_sweep("brdf.exponent=10:30"), parse_sweep("weave.height=0.25"),
                                         parse_sweep("brdf.measured=a.binary:b.binary")};
  EXPECT_EQ(values_at(both, "brdf", 1, 3), (Values{{"exponent", "20"}, {"measured", "0.5"}}));
  EXPECT_EQ(values_at(both, "weave", 1, 3), (Values{{"height", "0.25"}}));
}

Material material_of(NormalDistribution distribution) {
  Material material;
  material.name = "cloth";
  material.brdf.distribution = distribution;
  return material;
}

std::string refusal(const std::map<std::string, std::string>& values, const Material& material) {
  Scene scene;
  scene.materials = {material};
  return test::usage_error([&] { set_brdf(values, nullptr, scene); });
}

TEST(BrdfEdit, SetsParametersOfAllMaterials) {
  Scene scene;
  scene.materials = {material_of(NormalDistribution::ggx), material_of(NormalDistribution::ggx)};
  scene.materials[1].lobe_parameter = 0.3F;
  set_brdf({{"roughness", "0.25"}, {"specular", "0.5"}, {"metallic", "0.75"}}, nullptr, scene);
  for (const Material& material : scene.materials) {
    EXPECT_EQ(material.roughness, 0.25F);
    EXPECT_FALSE(material.lobe_parameter.has_value());
    EXPECT_EQ(material.dielectric_specular, glm::vec3(0.5F));
    EXPECT_EQ(material.metallic, 0.75F);
  }
  set_brdf({{"alpha", "0.125"}}, nullptr, scene);
  EXPECT_EQ(scene.materials[0].lobe_parameter, 0.125F);
}

TEST(BrdfEdit, MixesMeasuredTables) {
  const MeasuredPair tables{ward_brdf(glm::vec3(0.1F), glm::vec3(0.2F), 0.2),
                            ward_brdf(glm::vec3(0.5F), glm::vec3(0.2F), 0.2)};
  Scene scene;
  scene.materials = {material_of(NormalDistribution::ggx)};
  scene.materials[0].microgeometry = std::make_shared<const Microgeometry>();
  set_brdf({{"measured", "0.25"}}, &tables, scene);
  const TabulatedBrdf wanted = ward_brdf(glm::vec3(0.2F), glm::vec3(0.2F), 0.2);
  const TabulatedBrdf& mixed = *scene.materials[0].microgeometry->brdf;
  for (const std::size_t cell : {std::size_t{0}, TabulatedBrdf::cell_count / 3, TabulatedBrdf::cell_count - 1})
    EXPECT_NEAR(mixed.values[cell].x, wanted.values[cell].x, 1e-5F * wanted.values[cell].x);
}

TEST(BrdfEdit, RefusesWhatAMaterialDoesNotHave) {
  using test::says;
  EXPECT_TRUE(
      says(refusal({{"exponent", "9"}}, material_of(NormalDistribution::ggx)), "cloth has another distribution"));
  EXPECT_TRUE(says(refusal({{"measured", "0"}}, material_of(NormalDistribution::ggx)), "has no small-scale geometry"));
  Material mapped = material_of(NormalDistribution::ggx);
  mapped.metallic_roughness_map.emplace();
  EXPECT_TRUE(says(refusal({{"roughness", "0.1"}}, mapped), "has its width from a map"));
  EXPECT_TRUE(says(refusal({{"metallic", "0.1"}}, mapped), "has its metalness from a map"));
  Material lobes = material_of(NormalDistribution::ggx);
  lobes.lobes.resize(2);
  EXPECT_TRUE(says(refusal({{"alpha", "0.1"}}, lobes), "has lobes of its own"));
}

TEST(ParameterSweep, RefusesWhatDoesNotFit) {
  const std::vector<std::pair<std::string, std::string>> wrong{
      {"warp_width=0.1:0.5", "KIND.PARAMETER=FROM:TO"},
      {"weave.warp_width", "KIND.PARAMETER=FROM:TO"},
      {".warp_width=1", "KIND.PARAMETER=FROM:TO"},
      {"weeve.warp_width=0.1:0.5", "did you mean `weave`"},
      {"weave.warp_widht=0.1:0.5", "did you mean `warp_width`"},
      {"weave.warp_width=0.1:2", "`2` is not valid"},
      {"weave.warp_width=0.1:", "`` is not valid"},
      {"weave.warp_width=nan:0.5", "`nan` is not valid"},
      {"weave.steps_along=4.5:8", "whole number"},
      {"grooves.profile=v:round", "a word has nothing between"},
      {"grooves.profile=w", "unknown value"},
      {"brdf.roughnes=0.1", "did you mean `roughness`"},
      {"brdf.roughness=0.1:2", "`2` is not valid"},
      {"flat.depth=1", "it has none"}};
  for (const auto& [text, expected] : wrong) {
    try {
      (void)parse_sweep(text);
      ADD_FAILURE() << text << " was taken";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::usage);
      EXPECT_NE(std::string(error.what()).find(expected), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("--set " + text), std::string::npos) << error.what();
    }
  }
}

TEST(ParameterSweep, BelongsToTheScenesKindOnce) {
  const std::vector<ParameterSweep> twice{parse_sweep("weave.height=0.1"), parse_sweep("weave.height=0.2")};
  EXPECT_THROW(check_sweeps(twice, &find_patch_kind("weave")), Error);
  const std::vector<ParameterSweep> other{parse_sweep("noise.slope=0.1")};
  EXPECT_THROW(check_sweeps(other, &find_patch_kind("weave")), Error);
  EXPECT_NO_THROW(check_sweeps(other, &find_patch_kind("noise")));
  EXPECT_THROW(check_sweeps(other, nullptr), Error);
  const std::vector<ParameterSweep> brdf{parse_sweep("brdf.roughness=0.1:0.2")};
  EXPECT_NO_THROW(check_sweeps(brdf, nullptr));
}

}  // namespace
}  // namespace footprint
