// The effective BRDF in C++ against the method's own shader.
#include "methods/iwasaki_sg/study/effective_brdf.hpp"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "methods/iwasaki_sg/material_table.hpp"
#include "renderer/core/numbers.hpp"
#include "renderer/microgeometry/direction_grid.hpp"
#include "tests/methods/iwasaki_materials.hpp"
#include "tests/support/method_probe.hpp"

namespace footprint::iwasaki_sg {
namespace {

using testing::patch_of;

// The largest difference between the two over the largest value.
double shader_difference(const Material& material, const std::map<std::string, std::string>& given) {
  const Options options(iwasaki_sg_method().info.options, given, "test");
  EffectSet effects = patch_effects(material) | testing::ProbedMethod::default_effects();
  effects.reset(static_cast<std::size_t>(Effect::masking_shadowing));
  const TableSettings settings = table_settings(material, options, effects);
  const MaterialTable table = patch_table(material.microgeometry->patch, settings, no_progress);
  const BrdfFunction brdf = effective_brdf(table, settings, facet_reflection(material, options),
                                           options.word("convolution") == "approximate");
  std::mt19937_64 random(7);
  std::vector<std::array<glm::vec4, 3>> inputs;
  for (int k = 0; k < 400; ++k) {
    const auto direction = [&] { return square_to_hemisphere({uniform(random), uniform(random)}); };
    inputs.push_back({glm::vec4(glm::vec3(direction()), 0), glm::vec4(glm::vec3(direction()), 0), {}});
  }
  const auto found =
      testing::probe_method({&iwasaki_sg_method(), &material, given, effects},
                            "return vec4(shade(e, Surface(vec3(0), vec3(1)), a.xyz, b.xyz).specular, 0);", inputs);
  double largest = 0.0, away = 0.0;
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    const glm::dvec3 expected = brdf(glm::dvec3(glm::vec3(inputs[k][0])), glm::dvec3(glm::vec3(inputs[k][1])));
    for (int c = 0; c < 3; ++c) {
      largest = std::max(largest, expected[c]);
      away = std::max(away, std::abs(expected[c] - found[k][c]));
    }
  }
  return away / largest;
}

Material weave(NormalDistribution distribution, float lobe) {
  const BaseBrdf brdf{distribution, GeometryTerm::none, FresnelTerm::none, true};
  return testing::patch_material(patch_of("weave", {{"warp_blue", "0.1"}}), brdf, lobe);
}

const std::map<std::string, std::string> small{{"facets", "2000"}, {"directions", "6"}};

std::map<std::string, std::string> with(std::map<std::string, std::string> more) {
  more.insert(small.begin(), small.end());
  return more;
}

TEST(EffectiveBrdf, IsThatOfTheShader) {
  EXPECT_LT(shader_difference(weave(NormalDistribution::blinn_phong, 40.0F), small), 1e-4);
  EXPECT_LT(shader_difference(weave(NormalDistribution::ggx, 0.2F), with({{"cosines", "published"}})), 1e-4);
  EXPECT_LT(shader_difference(weave(NormalDistribution::beckmann, 0.2F), with({{"lobe", "sg"}})), 1e-4);
  EXPECT_LT(shader_difference(weave(NormalDistribution::vmf, 30.0F), with({{"lobe", "sg"}, {"convolution", "exact"}})),
            1e-4);
}

TEST(EffectiveBrdf, IsThatOfTheShaderForATabulatedBrdf) {
  Material material = weave(NormalDistribution::ggx, 0.2F);
  Microgeometry geometry = *material.microgeometry;
  geometry.brdf = std::make_shared<const TabulatedBrdf>(ward_brdf({0.3F, 0.2F, 0.1F}, {0.3F, 0.4F, 0.5F}, 0.2));
  material.microgeometry = std::make_shared<const Microgeometry>(std::move(geometry));
  EXPECT_LT(shader_difference(material, small), 1e-4);
}

}  // namespace
}  // namespace footprint::iwasaki_sg
