// `masking=footprint` against areas that are summed over facets in double precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/methods/built_map.hpp"
#include "tests/support/method_probe.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing {
namespace {

struct Masker {
  glm::dvec3 mean;
  double share, alpha;
};

Scene masked_square(const Image& normals, NormalDistribution distribution, float alpha) {
  Scene scene = blinn_phong_square(normals, 1.0F);
  scene.materials[0].brdf = {distribution, GeometryTerm::smith, FresnelTerm::none, false};
  scene.materials[0].lobe_parameter = alpha;
  return scene;
}

const Words of_footprint{{"masking", "footprint"}, {"j", "8"}};

std::vector<Masker> maskers(const BuiltMap& map) {
  ProbeInputs inputs;
  for (int i = 0; i < 8; ++i)
    for (const float what : {0.0F, 1.0F}) inputs.push_back({glm::vec4(static_cast<float>(i)), glm::vec4(what), {}});
  const auto got = map.probe(
      "int i = int(a.x);\nif (i >= e.count) return vec4(0.0);\n"
      "return b.x == 0.0 ? vec4(lobes[i].xyz, shares[i].x) : vec4(lobeOf(lobes[i], weights[i]).base);",
      inputs);
  std::vector<Masker> out;
  for (std::size_t i = 0; i < got.size(); i += 2)
    if (got[i].w > 0.0F) out.push_back({glm::dvec3(glm::vec3(got[i])), got[i].w, got[i + 1].x});
  return out;
}

// The integral of D max(w.m, 0) over the facets m of a lobe.
double facing_area(const Masker& lobe, NormalDistribution distribution, const glm::dvec3& w) {
  static const std::vector<glm::dvec3> facets = hemisphere_grid(300, 300);
  const glm::dvec3 side = glm::normalize(glm::cross(lobe.mean, glm::dvec3(0.36, 0.8, -0.48)));
  const glm::dvec3 other = glm::cross(lobe.mean, side);
  double sum = 0.0;
  for (const glm::dvec3& m : facets) {
    const double cosine = glm::dot(w, m.x * side + m.y * other + m.z * lobe.mean);
    if (cosine > 0.0) sum += cosine * lobe_density({distribution, lobe.alpha}, 1.0 - m.z);
  }
  return sum * 2.0 * std::numbers::pi / static_cast<double>(facets.size());
}

double factor(const std::vector<Masker>& lobes, NormalDistribution distribution, const glm::dvec3& wi,
              const glm::dvec3& wo) {
  glm::dvec3 surface(0.0);
  double lit = 0.0, seen = 0.0;
  for (const Masker& lobe : lobes) {
    const double area = lobe.share / std::max(lobe.mean.z, 1.0 / std::sqrt(10.0));
    surface += area * lobe.mean;
    lit += area * facing_area(lobe, distribution, wi);
    seen += area * facing_area(lobe, distribution, wo);
  }
  const double lambdas = lit / glm::dot(surface, wi) + seen / glm::dot(surface, wo) - 2.0;
  return 0.25 / ((1.0 + lambdas) * glm::dot(glm::normalize(surface), wo));
}

glm::dvec3 above(double degrees, double azimuth) {
  const double theta = glm::radians(degrees), phi = glm::radians(azimuth);
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

std::vector<float> factors(const BuiltMap& map, const std::vector<std::pair<glm::dvec3, glm::dvec3>>& pairs,
                           const std::string& body) {
  ProbeInputs inputs;
  for (const auto& [wi, wo] : pairs)
    inputs.push_back({glm::vec4(glm::vec3(wi), 0.0F), glm::vec4(glm::vec3(wo), 0.0F), {}});
  std::vector<float> out;
  for (const glm::vec4& value : map.probe("return vec4(" + body + ");", inputs)) out.push_back(value.x);
  return out;
}

const std::vector<std::pair<glm::dvec3, glm::dvec3>>& directions() {
  static const std::vector<std::pair<glm::dvec3, glm::dvec3>> pairs{{above(0, 0), above(20, 40)},
                                                                    {above(50, 10), above(60, 200)},
                                                                    {above(75, 100), above(30, 300)},
                                                                    {above(20, 90), above(80, 90)}};
  return pairs;
}

TEST(XuMasking, IsThatOfAllLobesOfTheFootprint) {
  for (const NormalDistribution distribution : {NormalDistribution::ggx, NormalDistribution::beckmann}) {
    for (const float tilt : {0.5F, 0.8F}) {
      const BuiltMap map(masked_square(random_normals(16, 16, tilt, 4), distribution, 0.3F), of_footprint);
      const std::vector<Masker> lobes = maskers(map);
      ASSERT_GE(lobes.size(), 4U);
      const auto got = factors(map, directions(), "footprintFactor(e.count, a.xyz, b.xyz)");
      for (std::size_t i = 0; i < got.size(); ++i) {
        const auto& [wi, wo] = directions()[i];
        EXPECT_NEAR(got[i] / factor(lobes, distribution, wi, wo), 1.0, 0.01) << tilt << " " << i;
      }
    }
  }
}

// Where there is one lobe, there is nothing else to mask it: the term is that of the base BRDF about it.
TEST(XuMasking, IsTheBaseTermOfASingleLobe) {
  for (const NormalDistribution distribution : {NormalDistribution::ggx, NormalDistribution::beckmann}) {
    const BuiltMap map(masked_square(constant_normals(4, 4, {0.28F, -0.1F, 0.95F}), distribution, 0.3F), of_footprint);
    const auto shared = factors(map, directions(), "footprintFactor(e.count, a.xyz, b.xyz)");
    const auto own =
        factors(map, directions(),
                "geometryFactor(lobeOf(lobes[0], weights[0]).base, lobes[0].xyz, halfVector(a.xyz, b.xyz), "
                "a.xyz, b.xyz)");
    for (std::size_t i = 0; i < own.size(); ++i) EXPECT_NEAR(shared[i] / own[i], 1.0, 1e-4) << i;
  }
}

}  // namespace
}  // namespace footprint::testing
