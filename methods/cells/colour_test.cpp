// Colour with the lobe (specular=joint), against sums over texels in doubles.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/coloured_lobes.hpp"

namespace footprint {
const Method& cells_method();
}

namespace footprint::testing {
namespace {

using Words = std::map<std::string, std::string>;
const Words separate{{"k", "2"}}, joint{{"k", "2"}, {"specular", "joint"}};
const glm::vec3 red(0.8F, 0.1F, 0.05F), blue(0.05F, 0.1F, 0.6F);

double sum_of(const std::vector<glm::dvec3>& values, int channel) {
  double sum = 0.0;
  for (const glm::dvec3& v : values) sum += v[channel];
  return sum;
}

// A wall of each colour: each part has the colour of its own texels.
TEST(CellsColour, IsThatOfThePartsOwnTexels) {
  const std::vector<glm::dvec3> directions = hemisphere_grid(40, 80);
  const ColouredLobes walls = coloured_walls(0.4F, red, blue);
  const std::vector<glm::dvec3> exact = walls.exact(directions);
  for (const char* const covariance : {"axes", "full"}) {
    Words words = joint;
    words["covariance"] = covariance;
    EXPECT_LT(relative_l2(walls.specular(cells_method(), words, directions), exact), 1e-3) << covariance;
  }
  Words half = joint;
  half["storage"] = "fp16";
  EXPECT_LT(relative_l2(walls.specular(cells_method(), half, directions), exact), 0.01);
  EXPECT_GT(relative_l2(walls.specular(cells_method(), separate, directions), exact), 0.4) << "the gate";
}

// Flat normals under two lobes with a colour each, as the threads of `pillow_tied`.
TEST(CellsColour, GoesWithTheGlossOfFlatNormals) {
  const std::vector<glm::dvec3> directions = hemisphere_grid(40, 80);
  ColouredLobes threads = coloured_walls(0.0F, red, blue);
  threads.alphas = Image(32, 32, 1);
  for (std::size_t i = 0; i < threads.alphas.texels.size(); ++i)
    threads.alphas.texels[i] = (i % 32 / 4) % 2 == 0 ? 0.1F : 0.5F;
  const std::vector<glm::dvec3> exact = threads.exact(directions);
  EXPECT_LT(relative_l2(threads.specular(cells_method(), joint, directions, false), exact), 1e-3);
  EXPECT_LT(relative_l2(threads.specular(cells_method(), {{"specular", "joint"}}, directions, false), exact), 1e-3)
      << "four parts of two lobes";
  EXPECT_GT(relative_l2(threads.specular(cells_method(), separate, directions, false), exact), 0.4) << "the gate";
}

// Random normals, lobes and colours: the energy of each channel is that of the sum.
TEST(CellsColour, KeepsTheEnergyOfEachChannel) {
  const std::vector<glm::dvec3> directions = hemisphere_grid(120, 120);
  ColouredLobes mixed{random_normals(16, 16, 0.4F, 3), Image(16, 16, 1), Image(16, 16, 3)};
  for (std::size_t i = 0; i < 256; ++i) {
    mixed.alphas.texels[i] = i % 3 == 0 ? 0.12F : 0.3F;
    for (std::size_t c = 0; c < 3; ++c) mixed.colours.texels[3 * i + c] = 0.1F + 0.2F * static_cast<float>((i + c) % 4);
  }
  const std::vector<glm::dvec3> exact = mixed.exact(directions);
  for (const Words& words : {joint, Words{{"specular", "joint"}, {"roughness", "separate"}},
                             Words{{"specular", "joint"}, {"coordinates", "slopes"}}}) {
    const std::vector<glm::dvec3> found = mixed.specular(cells_method(), words, directions);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum_of(found, c) / sum_of(exact, c), 1.0, 0.02) << c;
    EXPECT_TRUE(std::ranges::all_of(found, [](const glm::dvec3& v) { return std::min({v.x, v.y, v.z}) >= 0.0; }));
  }
}

TEST(CellsColour, OneColourIsSeparate) {
  const std::vector<glm::dvec3> directions = hemisphere_grid(20, 40);
  ColouredLobes plain{random_normals(16, 16, 0.4F, 3), {}, Image(16, 16, 3)};
  for (std::size_t i = 0; i < plain.colours.texels.size(); ++i) plain.colours.texels[i] = (&red.x)[i % 3];
  const std::vector<glm::dvec3> expected = plain.specular(cells_method(), separate, directions);
  EXPECT_LT(relative_l2(plain.specular(cells_method(), joint, directions), expected), 1e-6);
}

TEST(CellsColour, ABlackTexelHasNoPartInTheHighlight) {
  const std::vector<glm::dvec3> directions = hemisphere_grid(20, 40);
  ColouredLobes one{random_normals(16, 16, 0.4F, 3), {}, Image(16, 16, 3, 0.5F)};
  for (std::size_t i = 0; i < 256; i += 3) std::fill_n(&one.colours.texels[3 * i], 3, 0.0F);
  ColouredLobes other = one;
  const Image others = random_normals(16, 16, 0.8F, 4);
  for (std::size_t i = 0; i < 256; i += 3) std::copy_n(&others.texels[4 * i], 3, &other.normals.texels[4 * i]);
  const std::vector<glm::dvec3> found = one.specular(cells_method(), joint, directions);
  EXPECT_EQ(other.specular(cells_method(), joint, directions), found);
  EXPECT_GT(relative_l2(other.specular(cells_method(), separate, directions),
                        one.specular(cells_method(), separate, directions)),
            0.05)
      << "the gate";
}

// A footprint of black texels alone reflects nothing, and nothing is undefined.
TEST(CellsColour, BlackIsBlack) {
  const std::vector<glm::dvec3> directions = hemisphere_grid(10, 20);
  const ColouredLobes black{random_normals(8, 8, 0.4F, 3), {}, Image(8, 8, 3)};
  for (const glm::dvec3& v : black.specular(cells_method(), joint, directions)) EXPECT_EQ(v, glm::dvec3(0.0));
}

TEST(CellsColour, DiffuseLightWeighsByArea) { expect_diffuse_light_by_area(cells_method(), joint); }

TEST(CellsColour, ColoursThatLieElsewhereAreFilteredOnTheirOwn) {
  expect_separate_where_colours_lie_elsewhere(cells_method(), joint, separate);
}

}  // namespace
}  // namespace footprint::testing
