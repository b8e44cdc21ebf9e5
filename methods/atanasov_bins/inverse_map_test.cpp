// The inverse bin map: every texel once, where it belongs; its count under any parallelogram against a plain sum; and
// the sampling of normals, whose density it is.
#include "methods/atanasov_bins/inverse_map.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <cstring>
#include <map>
#include <numeric>
#include <random>
#include <set>

#include "renderer/bake/prefiltered.hpp"
#include "renderer/core/error.hpp"
#include "tests/methods/bins_twin.hpp"

namespace footprint::atanasov_bins {
namespace {

using testing::Parallelogram;

// Random normals, `tilt` the largest sine, but for a square in which all are alike and a few texels without a normal.
Image some_normals(int width, int height, double tilt, bool with_invalid = true) {
  Image image(width, height, 4);
  std::mt19937 random(static_cast<std::uint32_t>(width * 1000 + height));
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const bool same = x > width / 2 && y > height / 2;
      const double nx = same ? 0.1 : 0.7 * tilt * unit(random), ny = same ? -0.05 : 0.7 * tilt * unit(random);
      const glm::vec4 n(nx, ny, std::sqrt(1.0 - nx * nx - ny * ny), with_invalid && x % 7 == 3 && y % 5 == 1 ? 0 : 1);
      std::copy_n(&n.x, 4, image.at(x, y).begin());
    }
  }
  return image;
}

struct Maps {
  Maps(const Image& normals, int m) : bins(bin_map(normals, m, no_progress)), inverse(invert_map(bins, no_progress)) {}
  BinMap bins;
  InverseMap inverse;

  [[nodiscard]] std::uint32_t bin_at(int x, int y) const {
    const std::uint32_t packed = bins.normals[static_cast<std::size_t>(y * bins.width + x)];
    return packed == no_normal ? no_key : bin_of_packed(packed, bins.across);
  }
};

// A node's texels lie in its rectangle, and its links lead to where they should.
void expect_tree(const InverseMap& map, std::uint32_t at, std::uint32_t first, std::uint32_t end,
                 const TexelRect& rect) {
  for (std::uint32_t i = first; i < end; ++i) {
    const glm::ivec2 texel(map.texels[i] & 0xFFFFU, map.texels[i] >> 16U);
    ASSERT_TRUE(glm::all(glm::greaterThanEqual(texel, rect.lower)) && glm::all(glm::lessThan(texel, rect.upper)));
  }
  if (end - first <= leaf_size) return;
  ASSERT_LT(at, map.forest.size());
  const Branches branches = branches_of(map.forest, at, first, end);
  ASSERT_TRUE(first <= branches.upper_first && branches.upper_first <= end);
  const Halves halves = halves_of(rect);
  TexelRect lower = rect, upper = rect;
  (halves.along_x ? lower.upper.x : lower.upper.y) = halves.middle;
  (halves.along_x ? upper.lower.x : upper.lower.y) = halves.middle;
  expect_tree(map, branches.lower, first, branches.upper_first, lower);
  expect_tree(map, branches.upper, branches.upper_first, end, upper);
}

TEST(InverseMap, HasEveryTexelOnceInItsBinAndItsNode) {
  for (const glm::ivec2& size : {glm::ivec2(1, 1), {64, 64}, {457, 671}, {1, 300}, {300, 2}}) {
    for (const int m : {1, 5, 127}) {
      const Maps maps(some_normals(size.x, size.y, 0.9), m);
      const InverseMap& map = maps.inverse;
      ASSERT_EQ(map.texels.size(), maps.bins.normals.size());
      EXPECT_EQ(std::set<std::uint32_t>(map.texels.begin(), map.texels.end()).size(), map.texels.size());
      for (std::size_t i = 0; i < map.lists.size(); ++i) {
        ASSERT_TRUE(i == 0 || map.lists[i].key > map.lists[i - 1].key);
        ASSERT_GT(map.count_of(i), 0U);
        for (std::uint32_t k = map.lists[i].first; k < map.lists[i].first + map.count_of(i); ++k) {
          const int x = static_cast<int>(map.texels[k] & 0xFFFFU), y = static_cast<int>(map.texels[k] >> 16U);
          ASSERT_EQ(maps.bin_at(x, y), map.lists[i].key);
        }
        expect_tree(map, map.lists[i].root, map.lists[i].first, map.lists[i].first + map.count_of(i), {{0, 0}, size});
      }
    }
  }
}

// One list each, of texels around the number from which nodes are two integers.
TEST(InverseMap, NodesAreOneIntegerOrTwoByTheirTexels) {
  for (const glm::ivec2& size : {glm::ivec2(217, 151), {256, 128}, {10923, 3}}) {  // 2^15 texels, one less, one more
    const Maps maps(some_normals(size.x, size.y, 0.9, false), 1);
    const InverseMap& map = maps.inverse;
    ASSERT_EQ(map.lists.size(), 1U);
    const auto texels = static_cast<std::uint32_t>(map.texels.size());
    expect_tree(map, 0, 0, texels, {{0, 0}, size});
    const Branches branches = branches_of(map.forest, 0, 0, texels);
    EXPECT_EQ(branches.lower, texels < wide_node ? 1U : 2U);
    EXPECT_LT(branches.upper, map.forest.size());
  }
}

// A thousand lists a task, one list over several: nothing depends on who does what.
TEST(InverseMap, IsTheSameAtAnyNumberOfThreads) {
  for (const double tilt : {0.02, 0.9}) {
    const BinMap bins = bin_map(some_normals(700, 500, tilt), 63, no_progress);
    const InverseMap many = invert_map(bins, no_progress);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const InverseMap single = invert_map(bins, no_progress);
    EXPECT_EQ(many.texels, single.texels);
    EXPECT_EQ(many.forest, single.forest);
  }
}

TEST(InverseMap, HashFindsEveryListAndNoOther) {
  const Maps maps(some_normals(200, 100, 0.9), 63);
  const std::vector<std::uint32_t> table = hashed_lists(maps.inverse);
  const auto slots = static_cast<std::uint32_t>(table.size() / 2);
  const auto find = [&](std::uint32_t bin) {
    for (std::uint32_t slot = hash_slot(bin, slots); table[2 * slot] != no_key; slot = (slot + 1) % slots)
      if (table[2 * slot] == bin) return static_cast<int>(table[2 * slot + 1]);
    return -1;
  };
  std::size_t next = 0;
  for (std::uint32_t bin = 0; bin < 63 * 63; ++bin) {
    const bool there = next < maps.inverse.lists.size() && maps.inverse.lists[next].key == bin;
    EXPECT_EQ(find(bin), there ? static_cast<int>(next) : -1) << bin;
    if (there) ++next;
  }
  ASSERT_TRUE(maps.inverse.has_invalid());
  EXPECT_EQ(next + 1, maps.inverse.lists.size());
}

TEST(InverseMap, HasListsOfItsOwnForEveryClass) {
  const BinMap bins = bin_map(some_normals(60, 40, 0.9), 63, no_progress);
  TexelClasses classes{.across = {63, 9}, .of_texel = {}};
  for (std::size_t i = 0; i < bins.normals.size(); ++i) classes.of_texel.push_back(i % 7 < 3 ? 1 : 0);
  const InverseMap map = invert_map(bins, no_progress, classes);
  const std::vector<std::uint32_t> table = hashed_lists(map);
  std::size_t seen = 0;
  for (std::size_t i = 0; i + 1 < map.lists.size(); ++i) {
    ASSERT_TRUE(i == 0 || map.lists[i].key > map.lists[i - 1].key);
    for (std::uint32_t k = map.lists[i].first; k < map.lists[i].first + map.count_of(i); ++k) {
      const std::size_t texel = (map.texels[k] >> 16U) * 60 + (map.texels[k] & 0xFFFFU);
      const std::size_t own = classes.of_texel[texel];
      ASSERT_EQ(map.lists[i].key, bin_key(own, bin_of_packed(bins.normals[texel], classes.across[own])));
      ++seen;
    }
    std::size_t slot = hash_slot(map.lists[i].key, static_cast<std::uint32_t>(table.size() / 2));
    while (table[2 * slot] != map.lists[i].key) slot = (slot + 1) % (table.size() / 2);
    EXPECT_EQ(table[2 * slot + 1], i);
  }
  EXPECT_EQ(seen + map.count_of(map.lists.size() - 1), map.texels.size());
}

std::vector<Parallelogram> footprints_on(const glm::dvec2& size) {
  return {{{0.3 * size.x, 0.4 * size.y}, {{0.2 * size.x, 0.0}, {0.0, 0.3 * size.y}}},                      // aligned
          {{0.5 * size.x, 0.5 * size.y}, {{0.3 * size.x, 0.1 * size.y}, {-0.05 * size.x, 0.2 * size.y}}},  // sheared
          {{0.4 * size.x, 0.6 * size.y}, {{0.0, 0.5 * size.y}, {0.3 * size.x, 0.0}}},                      // mirrored
          {{0.31 * size.x, 0.44 * size.y}, {{0.3, 0.1}, {-0.1, 0.4}}},                      // under one texel
          {{0.5 * size.x, 0.5 * size.y}, {{0.5 * size.x, 0.4 * size.y}, {-0.002, 0.003}}},  // hardly any
          {0.5 * size, {{size.x, 0.0}, {0.0, size.y}}}};                                    // the whole map
}

// Section 2.3's count of every bin, and the sum of D|H| over all, against a plain sum.
TEST(InverseMap, CountsUnderAnyFootprintAsAPlainSumDoes) {
  for (const glm::ivec2& size : {glm::ivec2(1, 1), {64, 64}, {457, 671}}) {
    const Maps maps(some_normals(size.x, size.y, 0.9), 31);
    for (const Parallelogram& p : footprints_on(size)) {
      std::map<std::uint32_t, double> expected;
      testing::for_each_texel(p, size, Wrap::repeat,
                              [&](int x, int y, double area) { expected[maps.bin_at(x, y)] += area; });
      testing::WalkTwin walk(maps.inverse, p);
      double total = 0.0;
      for (std::size_t i = 0; i < maps.inverse.lists.size(); ++i) {
        const double found = walk.area(i);
        ASSERT_NEAR(found / p.area(), expected[maps.inverse.lists[i].key] / p.area(), 1e-6) << size.x << " " << i;
        total += found / p.area();
      }
      EXPECT_NEAR(total, 1.0, 1e-6) << size.x;
    }
  }
}

// What the test above would see of a link or a rectangle that is wrong.
TEST(InverseMap, AWrongTreeIsSeen) {
  Maps maps(some_normals(64, 64, 0.02), 31);
  InverseMap& map = maps.inverse;
  ASSERT_FALSE(map.forest.empty());
  const Parallelogram p = footprints_on({64, 64})[1];
  const auto areas = [&] {
    testing::WalkTwin walk(map, p);
    double sum = 0.0;
    for (std::size_t i = 0; i < map.lists.size(); ++i) sum += walk.area(i);
    return sum / p.area();
  };
  ASSERT_NEAR(areas(), 1.0, 1e-6);
  map.forest[map.lists.front().root] += 5;
  EXPECT_GT(std::abs(areas() - 1.0), 1e-3);
}

// One list of the whole map, as dense as a list may be: looked at are the nodes that the border cuts, of some 4 x 4
// texels and larger, and those beside them; none of those within.
TEST(InverseMap, VisitsFewNodes) {
  const Image flat = [] {
    Image image(1024, 1024, 4);
    for (std::size_t i = 2; i < image.texels.size(); i += 4) image.texels[i] = image.texels[i + 1] = 1.0F;
    return image;
  }();
  const Maps maps(flat, 127);
  ASSERT_EQ(maps.inverse.lists.size(), 1U);
  for (const double side : {3.0, 100.0, 1000.0}) {
    testing::WalkTwin walk(maps.inverse, {{512.3, 511.1}, {{side, 0.0}, {0.0, side}}});
    EXPECT_NEAR(walk.area(0), side * side, 1e-6 * side * side);
    EXPECT_LT(walk.nodes_visited(), 120.0 + 6.0 * side);
  }
}

TEST(InverseMap, MeansOfListsAreThoseOfTheirTexels) {
  const Image normals = some_normals(64, 64, 0.3);
  const Maps maps(normals, 15);
  Image columns(64, 64, 1);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) columns.at(x, y)[0] = static_cast<float>(x);
  }
  const std::vector<float> found = list_means(maps.inverse, columns);
  for (std::size_t i = 0; i < found.size(); ++i) {
    double sum = 0.0;
    for (std::uint32_t k = 0; k < maps.inverse.count_of(i); ++k)
      sum += maps.inverse.texels[maps.inverse.lists[i].first + k] & 0xFFFFU;
    EXPECT_NEAR(found[i], sum / maps.inverse.count_of(i), 1e-4) << i;
  }
}

// Section 2.1: a point of the footprint, its texel's bin, a normal anywhere in that bin. Chi-squared over the bins.
TEST(InverseMap, DensityIsThatOfSampling) {
  constexpr int m = 31;
  const Image normals = some_normals(64, 64, 0.6, false);
  const Maps maps(normals, m);
  const Parallelogram p = footprints_on({64, 64})[1];
  std::vector<double> counts(m * m, 0.0);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  constexpr int samples = 400'000;
  for (int i = 0; i < samples; ++i) {
    const glm::dvec4 u(unit(random), unit(random), unit(random), unit(random));
    counts[testing::bin_of(testing::drawn_normal(maps.bins, p, Wrap::repeat, u).value(), m)] += 1.0;
  }
  testing::WalkTwin walk(maps.inverse, p);
  double chi2 = 0.0, freedom = -1.0;
  for (std::size_t i = 0; i < maps.inverse.lists.size(); ++i) {
    const double density = walk.area(i) / (p.area() * bin_solid_angle(m));
    const double expected = samples * density * bin_solid_angle(m);
    if (expected < 5.0) continue;
    const double difference = counts[maps.inverse.lists[i].key] - expected;
    chi2 += difference * difference / expected;
    freedom += 1.0;
  }
  ASSERT_GT(freedom, 40.0);
  EXPECT_LT(std::abs(chi2 - freedom), 5.0 * std::sqrt(2.0 * freedom));
}

TEST(InverseMap, WordsComeBackFromTextures) {
  std::vector<std::uint32_t> words(1000);
  std::iota(words.begin(), words.end(), 0xFEFFFF00U);
  const PrefilteredTexture texture = make_word_texture("words", 32, words);
  EXPECT_EQ(texture.levels.front().width, 32);
  EXPECT_EQ(texture.levels.front().height, 32);
  for (std::size_t i = 0; i < words.size(); ++i) {
    std::uint32_t word = 0;
    std::memcpy(&word, &texture.levels.front().bytes[4 * i], sizeof(word));
    ASSERT_EQ(word, words[i]);
  }
}

TEST(InverseMap, RefusesMapsThatExceedTextures) {
  Image wide;
  wide.width = 16385;
  wide.height = 1;
  wide.channels = 4;
  EXPECT_THROW((void)bin_map(wide, 127, no_progress), Error);
}

}  // namespace
}  // namespace footprint::atanasov_bins
