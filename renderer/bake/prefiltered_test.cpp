// Storage of baked textures: rounding, clamping, bytes.
#include "renderer/bake/prefiltered.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "renderer/core/error.hpp"

namespace footprint {
namespace {

Image row(std::initializer_list<float> values) {
  Image image(static_cast<int>(values.size()), 1, 1);
  image.texels = values;
  return image;
}

TEST(MakeTexture, Fp32IsExact) {
  const Image image = row({0.1F, -3e38F, 1e-40F});
  EXPECT_EQ(decode_level(make_texture("t", {image}, Storage::fp32, {}), 0).texels, image.texels);
}

TEST(MakeTexture, Fp16RoundsToNearestAndClamps) {
  // 1 + 2^-11 is halfway: to even. 1 + 3 * 2^-12 rounds up; truncation would give 1.
  const PrefilteredTexture t =
      make_texture("t", {row({1.0F + 0x1p-11F, 1.0F + 3 * 0x1p-12F, 1e6F, -1e6F})}, Storage::fp16, {});
  EXPECT_EQ(decode_level(t, 0).texels, (std::vector<float>{1.0F, 1.0F + 0x1p-10F, 65504.0F, -65504.0F}));
}

TEST(MakeTexture, Unorm8RoundsAndTakesSigns) {
  EXPECT_EQ(make_texture("t", {row({0.0F, 0.5F, 1.0F, 2.0F, -1.0F})}, Storage::unorm8, {}).levels[0].bytes,
            (std::vector<std::uint8_t>{0, 128, 255, 255, 0}));
  EXPECT_EQ(make_texture("t", {row({-1.0F, 0.0F, 1.0F})}, Storage::unorm8, {}, true).levels[0].bytes,
            (std::vector<std::uint8_t>{0, 128, 255}));
}

TEST(MakeTexture, NamesTheTexelThatIsNotFinite) {
  Image image(3, 2, 2, 0.0F);
  image.at(1, 1)[1] = std::numeric_limits<float>::quiet_NaN();
  try {
    (void)make_texture("moments", {image}, Storage::fp32, {});
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("moments"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("(1, 1)"), std::string::npos);
  }
}

TEST(ByteCount, IsTheSizeOnTheGpu) {
  const Image fine(4, 2, 3), coarse(2, 1, 3), last(1, 1, 3);
  const Prefiltered p{.textures = {make_texture("t", {fine, coarse, last}, Storage::fp16, {})},
                      .scalars = {{"s", 1.0F}},
                      .vectors = {{"v", {{1.0F, 2.0F}, {3.0F, 4.0F}}}}};
  EXPECT_EQ(byte_count(p), (8U + 2U + 1U) * 3U * 2U + 4U + 2U * 8U);
}

TEST(FinestTexels, AreThoseOfTheLargestMap) {
  EXPECT_EQ(finest_texels({}), 0U);
  Prefiltered p{.textures = {make_texture("a", {Image(4, 2, 1), Image(2, 1, 1), Image(1, 1, 1)}, Storage::fp32, {}),
                             make_texture("b", {Image(3, 3, 1), Image(1, 1, 1)}, Storage::fp32, {})},
                .scalars = {}};
  EXPECT_EQ(finest_texels(p), 9U);
  p.textures.push_back(make_level_texture("table", Image(50, 50, 1), Storage::fp32, {}));
  p.textures.back().filter = TextureFilter::linear;
  EXPECT_EQ(finest_texels(p), 9U);
}

TEST(Storage, WordsAreChecked) {
  EXPECT_EQ(parse_storage("fp16"), Storage::fp16);
  EXPECT_EQ(storage_name(Storage::unorm8), "unorm8");
  EXPECT_THROW((void)parse_storage("fp17"), Error);
}

}  // namespace
}  // namespace footprint
