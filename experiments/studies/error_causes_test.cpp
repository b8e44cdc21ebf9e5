// Errors by cause on pictures of a few pixels, and which parts of a picture an exact sum is afforded for.
#include "experiments/studies/bound.hpp"
#include "experiments/studies/flicker.hpp"
#include "experiments/studies/pixel_parts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "renderer/image/metrics.hpp"
#include "renderer/pipeline/supersample.hpp"

namespace footprint {
namespace {

Image noise(int edge, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<float> uniform(0.0F, 1.0F);
  Image image(edge, edge, 4, 1.0F);
  for (std::size_t i = 0; i < image.texels.size(); ++i) {
    if (i % 4 != 3) image.texels[i] = uniform(generator);
  }
  return image;
}

// Every second column is interior.
Interior stripes(int edge) {
  Interior interior{.mask = Image(edge, edge, 1), .texels = Image(edge, edge, 1)};
  for (std::size_t i = 0; i < interior.mask.texels.size(); i += 2) interior.mask.texels[i] = 1.0F;
  return interior;
}

Interior everywhere(int edge, float is_interior) {
  return {.mask = Image(edge, edge, 1, is_interior), .texels = Image(edge, edge, 1)};
}

TEST(PixelParts, ShareOutTheObject) {
  Image reference = noise(4, 1);
  reference.at(0, 0)[3] = 0.5F;  // interior by its mask, but no object pixel
  const PixelParts parts = pixel_parts(reference, stripes(4));
  EXPECT_EQ(parts.counts.object, 15U);
  EXPECT_EQ(parts.counts.interior, 7U);
  EXPECT_EQ(parts.counts.bound, std::nullopt);
  EXPECT_EQ(pixel_count(parts.edges), 8U);
  EXPECT_EQ(parts.interior.at(0, 0)[0] + parts.edges.at(0, 0)[0], 0.0F);
}

TEST(PixelParts, CountWhereThereIsSomethingToFilter) {
  Interior interior = stripes(4);
  EXPECT_EQ(pixel_parts(noise(4, 1), interior).counts.minified, 0U);
  interior.texels.texels = std::vector<float>(16, 1.0F);
  EXPECT_EQ(pixel_parts(noise(4, 1), interior).counts.minified, 0U);
  std::fill_n(interior.texels.texels.begin(), 6, 1.5F);  // three of them interior
  EXPECT_EQ(pixel_parts(noise(4, 1), interior).counts.minified, 3U);
}

// Shading and edges share the error out by their pixels.
TEST(ErrorCauses, PartsMakeTheWhole) {
  const Image reference = noise(8, 1), picture = noise(8, 2);
  const PixelParts parts = pixel_parts(reference, stripes(8));
  const ErrorCauses causes = error_causes(picture, reference, nullptr, parts, 1.0F);
  EXPECT_NEAR((32 * *causes.shading + 32 * *causes.edges) / 64,
              compare_images(picture, reference, 1.0F)->normalized_color, 1e-12);
  EXPECT_NE(*causes.shading, *causes.edges);
  EXPECT_FALSE(causes.filter || causes.method || causes.light);
}

TEST(ErrorCauses, OfPartsWithoutAPixelThereIsNone) {
  const Image reference = noise(4, 1), picture = noise(4, 2);
  const ErrorCauses causes =
      error_causes(picture, reference, nullptr, pixel_parts(reference, everywhere(4, 0.0F)), 1.0F);
  EXPECT_FALSE(causes.shading.has_value());
  EXPECT_TRUE(causes.edges.has_value());
}

// The triangle inequality: E(M, R) <= E(X, R) + E(M, X), for any images.
TEST(ErrorCauses, ShadingIsAtMostFilterAndMethod) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    const Image reference = noise(6, seed), picture = noise(6, 100 + seed);
    const PixelParts parts = pixel_parts(reference, stripes(6));
    const BoundPicture bound{.picture = noise(6, 200 + seed), .pixels = parts.interior};
    const ErrorCauses causes = error_causes(picture, reference, &bound, parts, 1.5F);
    EXPECT_LE(*causes.shading, *causes.filter + *causes.method + 1e-12);
    EXPECT_GE(*causes.shading, std::abs(*causes.filter - *causes.method) - 1e-12);
  }
}

// With the reference itself as the bound all is the method's; with the method as the bound all is the filter's.
TEST(ErrorCauses, TheEndsOfTheBound) {
  const Image reference = noise(6, 1), picture = noise(6, 2);
  const PixelParts parts = pixel_parts(reference, stripes(6));
  const auto causes = [&](const Image& bound) {
    const BoundPicture drawn{.picture = bound, .pixels = parts.interior};
    return error_causes(picture, reference, &drawn, parts, 1.0F);
  };
  EXPECT_EQ(*causes(reference).filter, 0.0);
  EXPECT_EQ(*causes(reference).method, *causes(reference).shading);
  EXPECT_EQ(*causes(picture).method, 0.0);
  EXPECT_EQ(*causes(picture).filter, *causes(picture).shading);
}

// The spread of errors against many noisy references is the one that each of them estimates.
TEST(ErrorNoise, IsTheSpreadOverReferences) {
  constexpr int edge = 24;
  constexpr float deviation = 0.02F;
  const Image exact = noise(edge, 1), picture = noise(edge, 2);
  const Image mask(edge, edge, 1, 1.0F);
  std::mt19937 generator(5);
  std::normal_distribution<float> normal(0.0F, deviation * std::sqrt(2.0F));  // of a half
  const auto half = [&] {
    Image image = exact;
    for (std::size_t i = 0; i < image.texels.size(); ++i) image.texels[i] += i % 4 == 3 ? 0.0F : normal(generator);
    return image;
  };
  double sum = 0, squares = 0, estimate = 0;
  constexpr int references = 200;
  for (int i = 0; i < references; ++i) {
    const std::pair halves(half(), half());
    Image reference = halves.first;
    for (std::size_t t = 0; t < reference.texels.size(); ++t)
      reference.texels[t] = 0.5F * (halves.first.texels[t] + halves.second.texels[t]);
    const double error = normalized_color(picture, reference, 1.0F, mask).value();
    sum += error;
    squares += error * error;
    estimate += error_noise(picture, halves, 1.0F, mask).value() / references;
  }
  const double spread = std::sqrt(squares / references - std::pow(sum / references, 2));
  EXPECT_NEAR(estimate / spread, 1.0, 0.2) << estimate << " beside " << spread;
  EXPECT_FALSE(error_noise(picture, {exact, exact}, 1.0F, Image(edge, edge, 1)).has_value());
}

TEST(WorkOfBound, IsThatOfTheFacetsUnderTheTexelsThatAFilterBlends) {
  EXPECT_EQ(estimated_exact_cost(0.0, {.lights = 1}), 4 + 16);
  EXPECT_EQ(estimated_exact_cost(1.0, {.lights = 1}), 4 + 16);
  EXPECT_EQ(estimated_exact_cost(5.0, {.lights = 3}), 3 * (64 + 256));
  EXPECT_EQ(estimated_exact_cost(1e6, {.lights = 1}), 2 * 128 * 128);
  EXPECT_EQ(estimated_exact_cost(5.0, {.lights = 1, .environment = true}), 51 * (64 + 256));
  EXPECT_EQ(estimated_exact_cost(1e6, {.environment = true}), 50 * 2 * 1428);
}

TEST(LeaveOutInfinite, TakesOnlyThosePixels) {
  Image picture = noise(4, 1), mask(4, 4, 1, 1.0F);
  picture.at(1, 2)[0] = std::nanf("");
  picture.at(3, 0)[2] = INFINITY;
  leave_out_infinite(picture, mask);
  EXPECT_EQ(pixel_count(mask), 14U);
  EXPECT_EQ(mask.at(1, 2)[0] + mask.at(3, 0)[0], 0.0F);
}

TEST(CheapParts, SpreadOverThePictureUpToWhatTheyMayCost) {
  constexpr int edge = 256;
  const PixelParts parts = pixel_parts(noise(edge, 1), stripes(edge));
  const PixelCost facets = [](int, int) { return estimated_exact_cost(5.0, {.lights = 1}); };
  const double a_tile = 320.0 * bound_tile * bound_tile;
  EXPECT_TRUE(cheap_parts(parts, bound_tile, facets, 0.5 * a_tile).empty());
  EXPECT_EQ(cheap_parts(parts, bound_tile, facets, 1e12).size(), 64U);
  const std::vector<Tile> some = cheap_parts(parts, bound_tile, facets, 16.5 * a_tile);
  ASSERT_EQ(some.size(), 16U);
  std::set<int> columns, rows;
  for (const Tile& tile : some) {
    columns.insert(tile.origin.x);
    rows.insert(tile.origin.y);
  }
  EXPECT_GE(columns.size(), 6U);
  EXPECT_GE(rows.size(), 6U);
  EXPECT_EQ(pixel_count(within(parts.interior, some)), 16U * bound_tile * bound_tile / 2);
}

// Tiles count from the bottom, pictures from the top.
TEST(CheapParts, LieWhereThePictureHasThem) {
  Image reference(64, 64, 4);
  for (int y = 0; y < 32; ++y) {
    for (int x = 32; x < 64; ++x) reference.at(x, y)[3] = 1.0F;  // the upper right
  }
  const PixelParts parts = pixel_parts(reference, everywhere(64, 1.0F));
  const std::vector<Tile> tiles = cheap_parts(
      parts, bound_tile, [](int, int) { return 1.0; }, 1e9);
  ASSERT_EQ(tiles.size(), 1U);
  EXPECT_EQ(tiles[0].origin, glm::ivec2(32, 32));
  EXPECT_EQ(pixel_count(within(parts.interior, tiles)), 1024U);
}

Reference view_of(const Image& reference, const Interior& interior) {
  Reference view;
  view.reference.mean = reference;
  view.parts = pixel_parts(reference, interior);
  return view;
}

// Only what changes otherwise than the reference flickers, and each cause counts its own pixels.
TEST(FlickerCauses, AreSeparatedByPixels) {
  const Image reference = noise(4, 1), before = noise(4, 2);
  Image picture = before;
  for (int y = 0; y < 4; ++y) {  // the second column is an edge, the third is interior
    for (int c = 0; c < 3; ++c)
      picture.at(1, y)[static_cast<std::size_t>(c)] = 1.0F - before.at(1, y)[static_cast<std::size_t>(c)];
  }
  const Reference view = view_of(reference, stripes(4));
  const FlickerCauses causes = flicker_causes(before, picture, view, view, 1.0F);
  EXPECT_EQ(causes.shading->mean, 0.0);
  EXPECT_GT(causes.edges->mean, 0.05);
  EXPECT_FALSE(causes.filter);
  EXPECT_FALSE(causes.method);
}

// A pixel that is interior in one frame alone is an edge.
TEST(FlickerCauses, AnInteriorPixelIsOneInBothFrames) {
  const Image reference = noise(4, 1);
  const Reference striped = view_of(reference, stripes(4)), none = view_of(reference, everywhere(4, 0.0F));
  const FlickerCauses causes = flicker_causes(reference, reference, striped, none, 1.0F);
  EXPECT_FALSE(causes.shading);
  EXPECT_EQ(causes.edges->mean, 0.0);
}

// The bound's own flicker is the filter's; a picture that is the bound has none of its own, and one that is the
// reference has the filter's, the other way round.
TEST(FlickerCauses, FilterAndMethodAreSeparatedByTheBound) {
  const Image old_reference = noise(4, 1), reference = noise(4, 2);
  const Image old_bound = noise(4, 3), bound = noise(4, 4);
  const Image all(4, 4, 1, 1.0F);
  Reference before = view_of(old_reference, everywhere(4, 1.0F)), now = view_of(reference, everywhere(4, 1.0F));
  before.bound = BoundPicture{.picture = old_bound, .pixels = all};
  now.bound = BoundPicture{.picture = bound, .pixels = all};
  const FlickerCauses same = flicker_causes(old_bound, bound, before, now, 1.0F);
  EXPECT_GT(same.filter->mean, 0.1);
  EXPECT_GE(same.filter->p99, same.filter->mean);
  EXPECT_EQ(same.method->mean, 0.0);
  const FlickerCauses own = flicker_causes(old_reference, reference, before, now, 1.0F);
  EXPECT_EQ(own.shading->mean, 0.0);
  EXPECT_NEAR(own.method->mean, same.filter->mean, 1e-12);
}

}  // namespace
}  // namespace footprint
