// Images over the same few samples, compared with one over many.
#include "experiments/studies/reference_noise.hpp"

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

}  // namespace
}  // namespace footprint
