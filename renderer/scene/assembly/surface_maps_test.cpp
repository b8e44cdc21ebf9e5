// Decoding of normal, roughness and colour maps against values worked out by hand.
#include "renderer/scene/assembly/surface_maps.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "renderer/core/error.hpp"
#include "renderer/image/image_io.hpp"
#include "tests/support/fresh_folder.hpp"
#include "tests/support/says.hpp"

namespace footprint {
namespace {

Image one_texel(std::vector<float> channels) {
  Image image(1, 1, static_cast<int>(channels.size()));
  image.texels = std::move(channels);
  return image;
}

TEST(SurfaceMaps, NormalsAreDecodedScaledAndRenormalised) {
  // Stored (0.8, 0.5, 0.9) is (0.6, 0, 0.8); x doubled: (1.2, 0, 0.8) / sqrt(2.08).
  const NormalMap map = decode_normal_map(one_texel({0.8F, 0.5F, 0.9F}), 2.0);
  EXPECT_NEAR(map.image.texels[0], 1.2 / std::sqrt(2.08), 1e-6);
  EXPECT_NEAR(map.image.texels[1], 0.0, 1e-6);
  EXPECT_NEAR(map.image.texels[2], 0.8 / std::sqrt(2.08), 1e-6);
  EXPECT_EQ(map.image.texels[3], 1.0F);
  EXPECT_EQ(map.invalid + map.inverted, 0U);
}

TEST(SurfaceMaps, TexelsWithoutDirectionHaveNoWeight) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const auto& texel : {std::vector{0.5F, 0.5F, 0.5F}, std::vector{nan, 0.5F, 1.0F}}) {
    const NormalMap map = decode_normal_map(one_texel(texel), 1.0);
    EXPECT_EQ(map.image.texels, (std::vector{0.0F, 0.0F, 1.0F, 0.0F}));
    EXPECT_EQ(map.invalid, 1U);
  }
}

// Heights of a sine along x over the columns and of a cosine along y: slopes by their derivatives.
TEST(SurfaceMaps, HeightsBecomeTheirSlopes) {
  constexpr int size = 256;
  constexpr double turn = 2.0 * std::numbers::pi / size;
  Image heights(size, size / 2, 1);  // lengths are in widths
  for (int y = 0; y < size / 2; ++y) {
    for (int x = 0; x < size; ++x)
      heights.at(x, y)[0] = static_cast<float>(0.25 * (std::sin(3 * turn * x) + std::cos(2 * turn * y)));
  }
  const NormalMap map = normals_of_heights(heights, 0.1);
  EXPECT_EQ(map.invalid, 0U);
  for (const auto& [x, y] : {std::pair{0, 0}, std::pair{40, 100}, std::pair{255, 127}, std::pair{128, 7}}) {
    const auto n = map.image.at(x, y);
    const double along_x = 0.1 * 0.25 * 3 * turn * size * std::cos(3 * turn * x);
    const double down = -0.1 * 0.25 * 2 * turn * size * std::sin(2 * turn * y);
    EXPECT_NEAR(n[0] / n[2], -along_x, 1e-3) << x << " " << y;
    EXPECT_NEAR(n[1] / n[2], down, 1e-3) << x << " " << y;
  }
}

TEST(SurfaceMaps, AHeightThatIsNoneHasNoSlopeAboutIt) {
  Image heights(5, 5, 1);
  heights.at(2, 2)[0] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(normals_of_heights(heights, 1.0).invalid, 4U);
  EXPECT_EQ(normals_of_heights(Image(1, 1, 1, 0.5F), 1.0).image.texels, (std::vector{0.0F, 0.0F, 1.0F, 1.0F}));
}

TEST(SurfaceMaps, SlopesAreScaled) {
  Image normals(1, 1, 4);
  normals.texels = {0.6F, 0.0F, 0.8F, 1.0F};
  scale_slopes(normals, 2.0);
  EXPECT_NEAR(normals.texels[0] / normals.texels[2], 1.5, 1e-6);
  EXPECT_EQ(normals.texels[3], 1.0F);
}

TEST(SurfaceMaps, TexelsPointingInwardsAreLaidFlat) {
  const NormalMap map = decode_normal_map(one_texel({1.0F, 0.5F, 0.0F}), 1.0);
  EXPECT_EQ(map.inverted, 1U);
  EXPECT_NEAR(map.image.texels[0], 1.0F, 1e-6F);
  EXPECT_GT(map.image.texels[2], 0.0F);
  EXPECT_EQ(map.image.texels[3], 1.0F);
  const NormalMap straight_down = decode_normal_map(one_texel({0.5F, 0.5F, 0.0F}), 1.0);
  EXPECT_NEAR(straight_down.image.texels[2], 1.0F, 1e-6F);
  EXPECT_EQ(describe_faults(map, "n.png").size(), 1U);
}

// An EXR of unit normals: taken as it is, renormalised, faults as ever.
TEST(SurfaceMaps, UnitNormalsAreTakenAsTheyAre) {
  Image stored(5, 1, 3);
  stored.texels = {0.6F, 0, 0.8F, 0, -0.601F, 0.799F, 0, 0, 0, -1, 0, 0, 0, 0, 1};
  const NormalMap map = decode_unit_normals(stored);
  EXPECT_EQ(map.image.at(0, 0)[0], 0.6F);
  const auto second = map.image.at(1, 0);
  EXPECT_NEAR(std::hypot(second[1], second[2]), 1.0F, 1e-6F);
  EXPECT_EQ(map.image.at(2, 0)[3], 0.0F);
  EXPECT_EQ(map.invalid, 1U);
  EXPECT_EQ(map.inverted, 1U);
}

TEST(SurfaceMaps, UnitNormalsThatAreNoneAreRefused) {
  const auto refusal = [](const Image& stored) -> std::string {
    try {
      (void)decode_unit_normals(stored);
    } catch (const Error& error) {
      return error.message();
    }
    return "none";
  };
  EXPECT_NE(refusal(one_texel({0.8F, 0.5F, 0.9F})).find("encoded as 0 to 1"), std::string::npos);
  EXPECT_NE(refusal(one_texel({3.0F, 4.0F, 0.0F})).find("do not contain a unit vector"), std::string::npos);
  EXPECT_NE(refusal(one_texel({1.0F})).find("two channels or three"), std::string::npos);
  EXPECT_EQ(refusal(one_texel({0.0F, 0.0F, 0.0F})), "none");  // without a direction: no weight
}

TEST(SurfaceMaps, NormalMapsNeedTwoChannelsAtLeast) {
  EXPECT_THROW((void)decode_normal_map(Image(2, 2, 1, 0.5F), 1.0), Error);
}

// x and y alone: z makes the normal a unit vector, for any content of its channel; scaled as usual.
TEST(SurfaceMaps, TwoChannelsLeaveZToTheReader) {
  const auto expect_normal = [](const NormalMap& map, const glm::vec3& normal) {
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(map.image.texels[c], normal[static_cast<int>(c)], 1e-6F);
    EXPECT_EQ(map.image.texels[3], 1.0F);
  };
  expect_normal(decode_normal_map(one_texel({0.8F, 0.5F}), 1.0), {0.6F, 0.0F, 0.8F});
  expect_normal(decode_normal_map(one_texel({0.8F, 0.5F, 0.0F}), 1.0, NormalChannels::xy), {0.6F, 0.0F, 0.8F});
  expect_normal(decode_unit_normals(one_texel({0.0F, -0.6F})), {0.0F, -0.6F, 0.8F});
  expect_normal(decode_unit_normals(one_texel({0.0F, -0.6F, 7.0F}), 1.0, NormalChannels::xy), {0.0F, -0.6F, 0.8F});
  const float scaled = 1.2F / std::hypot(1.2F, 0.8F);
  expect_normal(decode_normal_map(one_texel({0.8F, 0.5F}), 2.0), {scaled, 0.0F, 0.8F / std::hypot(1.2F, 0.8F)});
  const NormalMap beyond = decode_normal_map(one_texel({1.0F, 1.0F}), 1.0);  // (1, 1): longer than a unit vector
  EXPECT_EQ(beyond.inverted, 1U);
  EXPECT_GT(beyond.image.texels[2], 0.0F);
}

// One rule for a plane, a layer and `ndf`: an EXR as it is, a PNG encoded.
TEST(SurfaceMaps, FilesOfNormalsAreReadByTheirFormat) {
  const auto folder = test::fresh_folder();
  Image unit(2, 1, 3), encoded(2, 1, 3);
  unit.texels = {0.6F, 0.0F, 0.8F, 0.0F, 0.0F, 1.0F};
  std::ranges::transform(unit.texels, encoded.texels.begin(), [](float value) { return 0.5F * value + 0.5F; });
  write_exr(folder / "unit.exr", unit);
  write_exr(folder / "encoded.exr", encoded);
  write_png(folder / "encoded.png", encoded);
  std::vector<std::string> faults;
  const auto read = [&](const char* file) {
    return read_normal_map(folder / file, 1.0, NormalChannels::xyz, faults).decoded();
  };
  EXPECT_FLOAT_EQ(read("unit.exr").texels[0], 0.6F);
  EXPECT_NEAR(read("encoded.png").texels[0], 0.6F, 4e-3F);
  EXPECT_TRUE(faults.empty());
  try {
    (void)read("encoded.exr");
    ADD_FAILURE() << "was taken";
  } catch (const Error& error) {
    EXPECT_TRUE(test::says(error.what(), "encoded.exr"));
    EXPECT_TRUE(test::says(error.what(), "encoded as 0 to 1"));
  }
}

TEST(SurfaceMaps, RoughnessIsGreenAndMetallicBlue) {
  const Image map = decode_metallic_roughness(one_texel({0.1F, 0.5F, 0.25F}), 0.5F, 0.8F);
  EXPECT_EQ(map.channels, 2);
  EXPECT_FLOAT_EQ(map.texels[0], 0.25F);
  EXPECT_FLOAT_EQ(map.texels[1], 0.2F);
  const Image grey = decode_metallic_roughness(one_texel({0.5F}), 1.0F, 1.0F);
  EXPECT_EQ(grey.texels, (std::vector{0.5F, 0.5F}));
}

TEST(SurfaceMaps, EveryChannelCountBecomesRgba) {
  EXPECT_EQ(to_rgba(one_texel({0.5F})).texels, (std::vector{0.5F, 0.5F, 0.5F, 1.0F}));
  EXPECT_EQ(to_rgba(one_texel({0.5F, 0.25F})).texels, (std::vector{0.5F, 0.5F, 0.5F, 0.25F}));
  EXPECT_EQ(to_rgba(one_texel({0.1F, 0.2F, 0.3F})).texels, (std::vector{0.1F, 0.2F, 0.3F, 1.0F}));
  EXPECT_EQ(to_rgba(one_texel({0.1F, -2.0F, 7.0F, 0.5F})).texels, (std::vector{0.1F, 0.0F, 1.0F, 0.5F}));
}

TEST(SurfaceMaps, IndicesBecomeAMapEach) {
  Image stored(3, 1, 2);
  stored.texels = {0.0F, 9.0F, 2.0F, 9.0F, 0.9999F, 9.0F};
  const std::vector<Image> shares = decode_indices(stored, 3);
  ASSERT_EQ(shares.size(), 3U);
  EXPECT_EQ(shares[0].texels, (std::vector{1.0F, 0.0F, 0.0F}));
  EXPECT_EQ(shares[1].texels, (std::vector{0.0F, 0.0F, 1.0F}));
  EXPECT_EQ(shares[2].texels, (std::vector{0.0F, 1.0F, 0.0F}));
}

TEST(SurfaceMaps, IndicesOutOfRangeNameTheirTexel) {
  for (const float wrong :
       {3.0F, -1.0F, 0.5F, 1e30F, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    Image stored(2, 2, 1);
    stored.texels[3] = wrong;
    try {
      (void)decode_indices(stored, 3);
      ADD_FAILURE() << wrong << " passed";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("texel (1, 1)"), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("0 to 2"), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace footprint
