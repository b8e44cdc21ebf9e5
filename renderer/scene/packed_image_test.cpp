// Every image comes back to the last bit, in as many bytes as its values need.
#include "renderer/scene/map_texels.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <limits>

namespace footprint {
namespace {

// Channel c has as many different values as counts[c], one after the other.
Image counting(int width, int height, std::initializer_list<int> counts) {
  Image image(width, height, static_cast<int>(counts.size()));
  std::size_t c = 0;
  for (const int count : counts) {
    for (std::size_t i = 0; i < image.texel_count(); ++i)
      image.texels[i * counts.size() + c] = static_cast<float>(i % static_cast<std::size_t>(count)) / 255.0F;
    ++c;
  }
  return image;
}

bool same_bits(const Image& a, const Image& b) {
  return a.width == b.width && a.height == b.height && a.channels == b.channels &&
         std::memcmp(a.texels.data(), b.texels.data(), a.texels.size() * sizeof(float)) == 0;
}

TEST(PackedImage, GivesBackTheImageInTheBytesThatItsValuesNeed) {
  const Image image = counting(512, 256, {1, 256, 257, 65536, 65537});
  const PackedImage packed(image);
  EXPECT_TRUE(same_bits(packed.unpacked(), image));
  const std::size_t texels = image.texel_count();
  const std::size_t tables = sizeof(float) * (1 + 256 + 257 + 65536);
  EXPECT_EQ(packed.byte_count(), tables + (0 + 1 + 2 + 2 + 4) * texels);
}

TEST(PackedImage, KeepsBitsThatCompareEqualOrNotAtAll) {
  Image image(4, 1, 1);
  const float quiet = std::numeric_limits<float>::quiet_NaN();
  const float payload = std::bit_cast<float>(std::bit_cast<std::uint32_t>(quiet) | 5U);
  image.texels = {0.0F, -0.0F, quiet, payload};
  EXPECT_TRUE(same_bits(PackedImage(image).unpacked(), image));
  Image other = image;
  other.texels[1] = 0.0F;
  EXPECT_FALSE(same_bits(PackedImage(other).unpacked(), image));  // the comparison can fail
}

TEST(PackedImage, TakesImagesOfOneTexelAndOfNone) {
  EXPECT_TRUE(same_bits(PackedImage(Image(1, 1, 3, 0.25F)).unpacked(), Image(1, 1, 3, 0.25F)));
  EXPECT_EQ(PackedImage().unpacked().texel_count(), 0U);
}

}  // namespace
}  // namespace footprint
