// Colour with the lobe (specular=joint), against sums over texels in doubles.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/coloured_lobes.hpp"

namespace footprint {
const Method& tan_gmm_method();
}

namespace footprint::testing {
namespace {

using Chosen = std::map<std::string, std::string>;
const Chosen apart{{"n", "2"}}, together{{"n", "2"}, {"specular", "joint"}};

// A bright wall and a dark one.
TEST(TanGmmColour, WeighsComponentsByTheirColour) {
  const std::vector<glm::dvec3> directions = hemisphere_grid(40, 80);
  const ColouredLobes walls = coloured_walls(0.4F, glm::vec3(0.8F), glm::vec3(0.08F));
  const std::vector<glm::dvec3> exact = walls.exact(directions);
  for (const char* const covariance : {"isotropic", "full"}) {
    Chosen words = together;
    words["covariance"] = covariance;
    EXPECT_LT(relative_l2(walls.specular(tan_gmm_method(), words, directions), exact), 0.01) << covariance;
    words["specular"] = "separate";
    EXPECT_GT(relative_l2(walls.specular(tan_gmm_method(), words, directions), exact), 0.4) << "the gate";
  }
}

// Colours that differ in hue have the luminance of their sum.
TEST(TanGmmColour, HasTheLuminanceOfTheSum) {
  const std::vector<glm::dvec3> directions = hemisphere_grid(40, 80);
  const ColouredLobes walls = coloured_walls(0.4F, {0.8F, 0.1F, 0.05F}, {0.05F, 0.1F, 0.6F});
  const auto grey = [](std::vector<glm::dvec3> values) {
    for (glm::dvec3& v : values) v = glm::dvec3(luminance(v.x, v.y, v.z));
    return values;
  };
  const std::vector<glm::dvec3> exact = grey(walls.exact(directions));
  EXPECT_LT(relative_l2(grey(walls.specular(tan_gmm_method(), together, directions)), exact), 0.01);
  EXPECT_GT(relative_l2(grey(walls.specular(tan_gmm_method(), apart, directions)), exact), 0.2) << "the gate";
}

// The variance of the base lobe is the mean by colour: of flat normals, one lobe of that width.
TEST(TanGmmColour, WeighsTheGlossByTheColour) {
  const std::vector<glm::dvec3> directions = hemisphere_grid(20, 40);
  ColouredLobes threads = coloured_walls(0.0F, glm::vec3(0.8F), glm::vec3(0.2F));
  threads.alphas = Image(32, 32, 1);
  for (std::size_t i = 0; i < threads.alphas.texels.size(); ++i)
    threads.alphas.texels[i] = (i % 32 / 4) % 2 == 0 ? 0.1F : 0.5F;
  const double mean_alpha = std::sqrt(0.8 * 0.1 * 0.1 + 0.2 * 0.5 * 0.5);  // alpha squared is linear in the variance
  std::vector<glm::dvec3> expected;
  expected.reserve(directions.size());
  for (const glm::dvec3& h : directions)
    expected.emplace_back(0.5 * base_density(NormalDistribution::ggx, mean_alpha, {0, 0, 1}, h));
  EXPECT_LT(relative_l2(threads.specular(tan_gmm_method(), together, directions, false), expected), 1e-4);
  for (const char* const covariance : {"isotropic", "full"}) {
    Chosen words = together;
    words["covariance"] = covariance;
    EXPECT_LT(relative_l2(threads.specular(tan_gmm_method(), words, directions), expected), 1e-3) << covariance;
  }
  EXPECT_GT(relative_l2(threads.specular(tan_gmm_method(), apart, directions, false), expected), 0.1) << "the gate";
}

TEST(TanGmmColour, KeepsTheEnergyOfTheSum) {
  const std::vector<glm::dvec3> directions = hemisphere_grid(120, 120);
  ColouredLobes mixed{random_normals(16, 16, 0.4F, 3), Image(16, 16, 1), Image(16, 16, 3)};
  for (std::size_t i = 0; i < 256; ++i) {
    mixed.alphas.texels[i] = i % 3 == 0 ? 0.12F : 0.3F;
    std::fill_n(&mixed.colours.texels[3 * i], 3, 0.1F + 0.2F * static_cast<float>(i % 4));
  }
  const auto sum_of = [](const std::vector<glm::dvec3>& values) {
    double sum = 0.0;
    for (const glm::dvec3& v : values) sum += v.y;
    return sum;
  };
  const std::vector<glm::dvec3> exact = mixed.exact(directions);
  for (const char* const covariance : {"isotropic", "full"}) {
    const std::vector<glm::dvec3> found =
        mixed.specular(tan_gmm_method(), {{"specular", "joint"}, {"covariance", covariance}}, directions);
    EXPECT_NEAR(sum_of(found) / sum_of(exact), 1.0, 0.02) << covariance;
    EXPECT_TRUE(std::ranges::all_of(found, [](const glm::dvec3& v) { return v.y >= 0.0; }));
  }
}

TEST(TanGmmColour, OneColourIsSeparate) {
  const std::vector<glm::dvec3> directions = hemisphere_grid(20, 40);
  const ColouredLobes plain{random_normals(16, 16, 0.4F, 3), Image(16, 16, 1, 0.3F), Image(16, 16, 3, 0.5F)};
  const std::vector<glm::dvec3> expected = plain.specular(tan_gmm_method(), apart, directions);
  EXPECT_LT(relative_l2(plain.specular(tan_gmm_method(), together, directions), expected), 1e-6);
}

TEST(TanGmmColour, ABlackTexelHasNoPartInTheHighlight) {
  const std::vector<glm::dvec3> directions = hemisphere_grid(20, 40);
  ColouredLobes one{random_normals(16, 16, 0.4F, 3), {}, Image(16, 16, 3, 0.5F)};
  for (std::size_t i = 0; i < 256; i += 3) std::fill_n(&one.colours.texels[3 * i], 3, 0.0F);
  ColouredLobes other = one;
  const Image others = random_normals(16, 16, 0.8F, 4);
  for (std::size_t i = 0; i < 256; i += 3) std::copy_n(&others.texels[4 * i], 3, &other.normals.texels[4 * i]);
  EXPECT_EQ(other.specular(tan_gmm_method(), together, directions),
            one.specular(tan_gmm_method(), together, directions));
  EXPECT_GT(relative_l2(other.specular(tan_gmm_method(), apart, directions),
                        one.specular(tan_gmm_method(), apart, directions)),
            0.05)
      << "the gate";
}

// A map as dark as 1e-3 of its brightest texel still has all of its components; black reflects nothing.
TEST(TanGmmColour, DarkAndBlackFootprintsAreDefined) {
  const std::vector<glm::dvec3> directions = hemisphere_grid(10, 20);
  ColouredLobes dark = coloured_walls(0.4F, glm::vec3(5e-5F), glm::vec3(1e-5F));
  std::fill_n(dark.colours.texels.begin(), 3, 1.0F);
  std::fill_n(&dark.normals.texels[0], 2, 0.0F);
  dark.normals.texels[2] = 1.0F;
  EXPECT_LT(relative_l2(dark.specular(tan_gmm_method(), {{"n", "4"}, {"specular", "joint"}}, directions),
                        dark.exact(directions)),
            0.05);
  const ColouredLobes black{random_normals(8, 8, 0.4F, 3), Image(8, 8, 1, 0.3F), Image(8, 8, 3)};
  for (const glm::dvec3& v : black.specular(tan_gmm_method(), together, directions)) EXPECT_EQ(v, glm::dvec3(0.0));
}

TEST(TanGmmColour, DiffuseLightWeighsByArea) {
  for (const char* const covariance : {"isotropic", "full"}) {
    SCOPED_TRACE(covariance);
    Chosen words = together;
    words["covariance"] = covariance;
    expect_diffuse_light_by_area(tan_gmm_method(), words);
  }
}

TEST(TanGmmColour, ColoursThatLieElsewhereAreFilteredOnTheirOwn) {
  expect_separate_where_colours_lie_elsewhere(tan_gmm_method(), together, apart);
}

}  // namespace
}  // namespace footprint::testing
