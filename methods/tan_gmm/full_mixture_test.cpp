// The module with whole covariances: its lobe against a twin, its energy, and what it is better at.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "renderer/core/error.hpp"
#include "tests/support/method_probe.hpp"
#include "tests/support/stretched_twin.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint {
const Method& tan_gmm_method();
}

namespace footprint::testing {
namespace {

using WordOptions = std::map<std::string, std::string>;

Material streaked_material(const Image& normals, NormalDistribution distribution, float lobe) {
  const BaseBrdf brdf{distribution, GeometryTerm::none, FresnelTerm::none, true};
  Material material = square_scene(normals, {.brdf = brdf}).materials[0];
  material.lobe_parameter = lobe;
  return material;
}

// Brushed: wide along x, narrow along y, about one mean.
Image streak(const glm::dvec2& mean) {
  std::mt19937 random(9);
  std::normal_distribution<double> normal(0.0, 1.0);
  Image image(16, 16, 4, 1.0F);
  for (int i = 0; i < 256; ++i) {
    const double x = mean.x + 0.12 * normal(random);
    const double y = mean.y + 0.02 * normal(random);
    const glm::vec3 n(x, y, std::sqrt(std::max(1.0 - x * x - y * y, 0.0)));
    std::copy_n(&n.x, 3, image.at(i % 16, i / 16).begin());
  }
  return image;
}

std::vector<double> ndf_of(const Material& material, const WordOptions& options, const std::vector<glm::dvec3>& h) {
  return probe_ndf({.method = &tan_gmm_method(), .material = &material, .options = options}, h);
}

// The mean of the texels' own lobes.
std::vector<double> exact_densities(const Material& material, const std::vector<glm::dvec3>& directions) {
  const Image normals = material.normal_map->image.decoded();
  std::vector<double> exact;
  for (const glm::dvec3& h : directions) {
    double sum = 0.0;
    for (std::size_t i = 0; i < normals.texels.size(); i += 4) {
      const glm::dvec3 n(normals.texels[i], normals.texels[i + 1], normals.texels[i + 2]);
      sum += base_density(material.brdf.distribution, *material.lobe_parameter, glm::normalize(n), h);
    }
    exact.push_back(sum / static_cast<double>(normals.texel_count()));
  }
  return exact;
}

double squared_distance(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

// One component has the normals' own moments over the disc; tilted away from the axes, a metric apart from the disc's.
TEST(TanGmmFull, OneComponentMeetsItsTwin) {
  const std::vector<glm::dvec3> directions = hemisphere_grid(12, 24);
  for (const glm::dvec2& mean : {glm::dvec2(0.0), glm::dvec2(0.3, -0.2)}) {
    const Image normals = streak(mean);
    const Material material = streaked_material(normals, NormalDistribution::blinn_phong, 64.0F);
    glm::dvec2 m(0.0);
    glm::dmat2 second(0.0);
    for (std::size_t i = 0; i < normals.texels.size(); i += 4) {
      const glm::dvec2 n(normals.texels[i], normals.texels[i + 1]);
      m += n / 256.0;
      second += glm::outerProduct(n, n) / 256.0;
    }
    const glm::dmat2 over_disc = second - glm::outerProduct(m, m);
    // d p / d n_xy at the mean by differences: the disc to the plane, through the sphere.
    const auto plane = [](const glm::dvec2& n) { return n / (1.0 + std::sqrt(1.0 - glm::dot(n, n))); };
    constexpr double step = 1e-6;
    const glm::dmat2 jacobian((plane(m + glm::dvec2(step, 0)) - plane(m - glm::dvec2(step, 0))) / (2.0 * step),
                              (plane(m + glm::dvec2(0, step)) - plane(m - glm::dvec2(0, step))) / (2.0 * step));
    const PartTwin twin{.share = 1.0, .mean = plane(m), .spread = jacobian * over_disc * glm::transpose(jacobian)};
    const std::vector<double> density = ndf_of(material, {{"covariance", "full"}, {"n", "1"}}, directions);
    const double peak = std::ranges::max(density);
    for (std::size_t i = 0; i < directions.size(); ++i)
      EXPECT_NEAR(density[i], twin.density(NormalDistribution::blinn_phong, 64.0, directions[i]), 1e-3 * peak) << i;
  }
}

TEST(TanGmmFull, KeepsTheEnergyOfTheSumOverTexels) {
  const std::vector<glm::dvec3> directions = hemisphere_grid(160, 160);
  const auto energy = [](const std::vector<double>& density) {
    double sum = 0.0;
    for (const double d : density) sum += d;
    return sum;
  };
  for (const auto& [distribution, lobe] :
       {std::pair{NormalDistribution::blinn_phong, 64.0F}, {NormalDistribution::ggx, 0.1F}}) {
    const Material material = streaked_material(random_normals(8, 8, 0.5F, 3), distribution, lobe);
    const double exact = energy(exact_densities(material, directions));
    for (const char* const storage : {"fp32", "fp16"})
      EXPECT_NEAR(energy(ndf_of(material, {{"covariance", "full"}, {"storage", storage}}, directions)) / exact, 1.0,
                  0.01)
          << storage << lobe;
  }
}

TEST(TanGmmFull, FitsAStreakThatTwoRoundOnesDoNot) {
  const std::vector<glm::dvec3> directions = hemisphere_grid(60, 120);
  const Material material = streaked_material(streak({0.2, 0.1}), NormalDistribution::blinn_phong, 512.0F);
  const std::vector<double> exact = exact_densities(material, directions);
  const double full = squared_distance(ndf_of(material, {{"covariance", "full"}, {"n", "2"}}, directions), exact);
  const double isotropic = squared_distance(ndf_of(material, {{"n", "2"}}, directions), exact);
  EXPECT_LT(full, 0.25 * isotropic);
}

TEST(TanGmmFull, KnowsOneLobeAFacet) {
  const Material material = streaked_material(streak({0.0, 0.0}), NormalDistribution::ggx, 0.2F);
  const Options options(tan_gmm_method().info.options, {{"covariance", "full"}}, "tan_gmm");
  EffectSet effects;
  effects.set(static_cast<std::size_t>(Effect::normal_variation));
  effects.set(static_cast<std::size_t>(Effect::multi_lobe));
  EXPECT_THROW((void)tan_gmm_method().precompute(material, options, effects, no_progress), Error);
}

}  // namespace
}  // namespace footprint::testing
