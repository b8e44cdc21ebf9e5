// The maps that a material stores: the same map at every call, in the bytes of the file's own depth.
#include "renderer/scene/map_texels.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <set>

#include "renderer/scene/assembly/surface_maps.hpp"

namespace footprint {
namespace {

constexpr int side = 64;

// Random texels as a file of 8 bits a channel is read.
Image bytes_as_floats(int channels) {
  Image image(side, side, channels);
  std::uint32_t state = 1;
  for (float& value : image.texels) {
    state = state * 1664525U + 1013904223U;
    value = static_cast<float>(state >> 24U) / 255.0F;
  }
  return image;
}

bool equal_bits(const Image& a, const Image& b) {
  return a.texels.size() == b.texels.size() &&
         std::memcmp(a.texels.data(), b.texels.data(), a.texels.size() * sizeof(float)) == 0;
}

TEST(MapTexels, KeepsNormalsOfEightBitsInAsMany) {
  const Image stored = bytes_as_floats(3);
  std::vector<std::string> faults;
  const auto decode = [](const Image& image) { return decode_normal_map(image, 0.7); };
  const MapTexels map = stored_normals({.image = stored}, decode, "noise", faults);
  EXPECT_EQ(faults.size(), 1U);  // half of them point inwards
  EXPECT_TRUE(equal_bits(map.decoded(), decode_normal_map(stored, 0.7).image));
  EXPECT_TRUE(equal_bits(map.decoded(), map.decoded()));
  EXPECT_EQ(map.channels(), 4);
  EXPECT_EQ(map.texel_count(), stored.texel_count());
  EXPECT_EQ(map.first()[2], map.decoded().texels[2]);
  EXPECT_EQ(map.byte_count(), 3 * (stored.texel_count() + 256 * sizeof(float)));
}

TEST(MapTexels, KeepsWhatIsComputedAsItIs) {
  const auto image = std::make_shared<const Image>(bytes_as_floats(4));
  const MapTexels map(image);
  EXPECT_TRUE(equal_bits(map.decoded(), *image));
  EXPECT_EQ(map.byte_count(), image->texels.size() * sizeof(float));
  EXPECT_EQ(MapTexels::packed(*image).byte_count(), 4 * (image->texel_count() + 256 * sizeof(float)));
}

TEST(MapTexels, AreEqualWhereTheyShareTexels) {
  const MapTexels one = MapTexels::packed(bytes_as_floats(1)), other = MapTexels::packed(bytes_as_floats(1));
  const MapTexels copy = one;  // NOLINT(performance-unnecessary-copy-initialization): what is tested
  EXPECT_EQ(one, copy);
  EXPECT_NE(one, other);
  EXPECT_EQ((std::set<MapTexels>{one, copy, other}.size()), 2U);
  const auto image = std::make_shared<const Image>(bytes_as_floats(1));
  EXPECT_EQ(MapTexels(image), MapTexels(image));
  EXPECT_FALSE(MapTexels());
  EXPECT_TRUE(static_cast<bool>(one));
}

}  // namespace
}  // namespace footprint
