// Images over the same few samples, compared with one over many.
#include "experiments/studies/reference_noise.hpp"
#include "experiments/studies/flicker.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "renderer/image/metrics.hpp"

namespace footprint {
namespace {

using ::testing::ElementsAre;
using ::testing::FloatEq;

Image pixel(float r, float g, float b, float alpha) {
  Image image(1, 1, 4);
  image.texels = {r, g, b, alpha};
  return image;
}

TEST(AsConverged, AddsWhatThePictureDiffersByOverItsOwnSamples) {
  const Image out =
      as_converged(pixel(0.5F, 0.25F, 0.0F, 1), pixel(0.25F, 0.5F, 0.5F, 1), pixel(0.375F, 1.0F, 0.25F, 1));
  EXPECT_THAT(out.texels, ElementsAre(0.625F, 0.75F, 0.0F, 1.0F)) << "not below 0";
}

TEST(AsConverged, OfTheReferencesOwnSamplesIsThePicture) {
  const Image reference = pixel(0.3F, 0.1F, 0.7F, 1);
  const Image out = as_converged(pixel(0.9F, 0.2F, 0.4F, 1), reference, reference);
  EXPECT_THAT(out.texels, ElementsAre(FloatEq(0.9F), FloatEq(0.2F), FloatEq(0.4F), 1.0F));
}

// A method whose finest level is the base BRDF has no error of representation, however few its samples.
TEST(AsConverged, OfAPictureThatIsTheReferencesIsTheReference) {
  const Image few = pixel(0.31F, 0.17F, 0.77F, 1), reference = pixel(0.3F, 0.1F, 0.7F, 1);
  EXPECT_EQ(as_converged(few, few, reference), reference);
  EXPECT_EQ(normalized_color(as_converged(few, few, reference), reference, 1.0F), 0.0);
}

TEST(AsConverged, IsCoveredAsTheReferenceIs) {
  const Image reference = pixel(0.3F, 0.1F, 0.7F, 0.5F);
  EXPECT_EQ(as_converged(pixel(0, 0, 0, 0), pixel(0.2F, 0.2F, 0.2F, 1), reference), reference);
  EXPECT_EQ(as_converged(pixel(0.9F, 0.9F, 0.9F, 1), pixel(0, 0, 0, 0), reference), reference);
  EXPECT_EQ(as_converged(pixel(0.9F, 0.9F, 0.9F, 1), pixel(0.2F, 0.2F, 0.2F, 1), reference).texels[3], 0.5F);
}

// The first of two grey pixels was a highlight that is gone: 0.75 of it is left in the image. The second pixel's error
// does not count.
TEST(Ghosting, IsTheErrorWhereTheReferenceGotDarker) {
  const auto greys = [](float first, float second) {
    Image image(2, 1, 4);
    image.texels = {first, first, first, 1, second, second, second, 1};
    return image;
  };
  const Supersampled before{.spp = 1, .mean = greys(1.0F, 0.5F), .standard_error = {}, .halves = {}};
  const Supersampled now{.spp = 1, .mean = greys(0.0F, 0.5F), .standard_error = {}, .halves = {}};
  EXPECT_NEAR(flicker_between(before.mean, greys(0.75F, 0.9F), before, now, 1.0F)->ghosting.value(), 0.75, 1e-6);
  EXPECT_EQ(flicker_between(before.mean, greys(0.0F, 0.9F), before, now, 1.0F)->ghosting, 0.0);
  EXPECT_FALSE(flicker_between(now.mean, greys(0.75F, 0.9F), now, before, 1.0F)->ghosting) << "it got brighter";
}

}  // namespace
}  // namespace footprint
