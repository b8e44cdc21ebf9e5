// Decoding of normal, roughness and colour maps against values worked out by hand.
#include "renderer/scene/assembly/surface_maps.hpp"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "renderer/core/error.hpp"
#include "renderer/image/image_io.hpp"
#include "tests/support/fresh_folder.hpp"
#include "tests/support/gltf_builder.hpp"
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

// A wave sin(a x + b y) over columns x and rows y has differences in closed form: along x, cos(a x + b y) sin(a) times
// the filter's mean of cos(b) over its rows; along y the same with a and b exchanged.
TEST(SurfaceMaps, HeightsBecomeTheSlopesOfAnAnalyticField) {
  constexpr int width = 48, height = 32;
  constexpr double turn = 2.0 * std::numbers::pi, a = 3 * turn / width, b = 2 * turn / height, scale = 0.1;
  Image heights(width, height, 2, 9.0F);  // a second channel does not count
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) heights.at(x, y)[0] = static_cast<float>(std::sin(a * x + b * y));
  }
  using Mean = double (*)(double);
  for (const auto& [filter, mean] : std::initializer_list<std::pair<SlopeFilter, Mean>>{
           {SlopeFilter::central, [](double) { return 1.0; }},
           {SlopeFilter::sobel, [](double phase) { return (1.0 + std::cos(phase)) / 2.0; }},
           {SlopeFilter::scharr, [](double phase) { return (5.0 + 3.0 * std::cos(phase)) / 8.0; }}}) {
    const Image map = normals_of_heights(heights, scale, {.filter = filter});
    double exact = 0.0, analytic = 0.0;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const auto n = map.at(x, y);
        const double wave = scale * width * std::cos(a * x + b * y);
        const double along_x = -n[0] / n[2], up = -n[1] / n[2];
        exact = std::max(
            {exact, std::abs(along_x - wave * std::sin(a) * mean(b)), std::abs(up + wave * std::sin(b) * mean(a))});
        analytic = std::max({analytic, std::abs(along_x - wave * a), std::abs(up + wave * b)});
        ASSERT_EQ(n[3], 1.0F);
      }
    }
    EXPECT_LT(exact, 4e-6);                     // of slopes up to 1.9, from 32-bit heights
    EXPECT_LT(analytic, scale * width * 0.04);  // the derivative itself, to second order of a texel
    EXPECT_GT(analytic, 1e-3);
  }
}

// A ramp that rises by 1 per texel to the right and by 2 down the rows. Its border repeats, or is clamped.
TEST(SurfaceMaps, HeightsBeyondTheBorderFollowTheWrap) {
  Image heights(6, 4, 1);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 6; ++x) heights.at(x, y)[0] = static_cast<float>(x + 2 * y);
  }
  const auto slopes = [&](const HeightSettings& settings, int x, int y) {
    const Image map = normals_of_heights(heights, 1.0 / 6.0, settings);  // 1 per texel
    const auto n = map.at(x, y);
    return glm::dvec2(-n[0], -n[1]) / static_cast<double>(n[2]);
  };
  const auto expect_slopes = [](const glm::dvec2& found, double along_x, double up) {
    EXPECT_NEAR(found.x, along_x, 1e-5);
    EXPECT_NEAR(found.y, up, 1e-5);
  };
  for (const SlopeFilter filter : {SlopeFilter::central, SlopeFilter::sobel, SlopeFilter::scharr}) {
    expect_slopes(slopes({filter}, 2, 2), 1.0, -2.0);  // rows run down
    expect_slopes(slopes({filter, {Wrap::repeat, Wrap::clamp_to_edge}}, 0, 1), (1.0 - 5.0) / 2.0, -2.0);
    expect_slopes(slopes({filter, {Wrap::clamp_to_edge, Wrap::repeat}}, 1, 3), 1.0, (4.0 - 0.0) / 2.0);
    expect_slopes(slopes({filter, {Wrap::clamp_to_edge, Wrap::mirrored_repeat}}, 0, 3), 0.5, -1.0);
  }
}

TEST(SurfaceMaps, HeightsOfOneTexelAreFlatAndStepsAreSteep) {
  EXPECT_EQ(normals_of_heights(Image(1, 1, 1, 0.5F), 100.0).texels, (std::vector{0.0F, 0.0F, 1.0F, 1.0F}));
  Image step(4, 1, 1);
  step.texels = {0.0F, 0.0F, 1.0F, 1.0F};
  const Image gentle = normals_of_heights(step, 0.5, {.wrap = {Wrap::clamp_to_edge, Wrap::repeat}});
  for (int x = 0; x < 4; ++x) EXPECT_NEAR(-gentle.at(x, 0)[0] / gentle.at(x, 0)[2], x == 1 || x == 2 ? 1.0 : 0.0, 1e-6);
  step.texels = {-3e38F, 3e38F, -3e38F, 3e38F};  // a texel's two neighbours are equal
  EXPECT_EQ(normals_of_heights(step, 100.0).at(1, 0)[2], 1.0F);
  step.texels = {0.0F, 0.0F, 3e38F, 3e38F};
  for (const float value : normals_of_heights(step, 100.0).texels) EXPECT_TRUE(std::isfinite(value));
  EXPECT_EQ(normals_of_heights(step, 100.0).at(1, 0)[2], 1e-6F);
}

TEST(SurfaceMaps, HeightsThatAreNotFiniteAreRefusedByTheirTexel) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), -std::numeric_limits<float>::infinity()}) {
    Image heights(5, 5, 1);
    heights.at(2, 3)[0] = bad;
    const std::string error = test::usage_error([&] { return normals_of_heights(heights, 1.0); });
    EXPECT_TRUE(test::says(error, "texel (2, 3)"));
    EXPECT_TRUE(test::says(error, "is not a height"));
  }
}

// 8 and 16 bits are read as 0 to 1, floats as they are: one wave in all three, to half a step of the bits.
TEST(SurfaceMaps, FilesOfHeightsAreReadAtTheirDepth) {
  const auto folder = test::fresh_folder();
  constexpr int size = 32;
  Image heights(size, size, 1);
  for (int x = 0; x < size * size; ++x)
    heights.texels[static_cast<std::size_t>(x)] = static_cast<float>(0.5 + 0.5 * std::sin(0.3 * (x % size)));
  write_exr(folder / "float.exr", heights);
  write_png(folder / "byte.png", heights);
  const auto output = OIIO::ImageOutput::create("png");
  ASSERT_TRUE(output->open((folder / "short.png").string(), {size, size, 1, OIIO::TypeDesc::UINT16}));
  ASSERT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, heights.texels.data()) && output->close());
  std::vector<std::string> faults;
  const auto read = [&](const char* file) {
    return read_normals({.path = folder / file, .scale = 0.1, .heights = HeightSettings{}}, faults).decoded();
  };
  const Image exact = normals_of_heights(heights, 0.1);
  EXPECT_EQ(read("float.exr"), exact);
  for (const auto& [file, step] : {std::pair{"byte.png", 1.0 / 255}, std::pair{"short.png", 1.0 / 65535}}) {
    const Image map = read(file);
    double most = 0.0;
    for (std::size_t i = 0; i < map.texel_count(); ++i)
      most = std::max(most, std::abs(static_cast<double>(map.texels[4 * i]) - exact.texels[4 * i]));
    EXPECT_LE(most, 0.1 * size * step * 0.5) << file;
    EXPECT_GT(most, 0.0) << file;
  }
  EXPECT_TRUE(faults.empty());
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
  const auto read = [&](const char* file) { return read_normals({.path = folder / file}, faults).decoded(); };
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

// A bumpy map, whose x and y have both signs, in two channels or with a third that does not count.
Image bumps_xy(int channels, float offset, float scale) {
  Image map(8, 8, channels, 0.0F);
  for_each_texel(map, [&](int x, int y) {
    map.at(x, y)[0] = offset + scale * 0.6F * std::sin(0.785F * static_cast<float>(x));
    map.at(x, y)[1] = offset + scale * 0.5F * std::cos(0.785F * static_cast<float>(y));
  });
  return map;
}

TEST(SurfaceMaps, TwoChannelsEncodedAsZeroToOneAreRefused) {
  for (const int channels : {2, 3}) {
    EXPECT_NO_THROW((void)decode_unit_normals(bumps_xy(channels, 0.0F, 1.0F), 1.0, NormalChannels::xy));
    for (const float scale : {0.5F, 0.05F, 0.0F}) {  // 0: a flat map
      const std::string error = test::usage_error(
          [&] { return decode_unit_normals(bumps_xy(channels, 0.5F, scale), 1.0, NormalChannels::xy); });
      EXPECT_TRUE(test::says(error, "encoded as 0 to 1")) << scale;
    }
    const std::string error =
        test::usage_error([&] { return decode_unit_normals(bumps_xy(channels, 0.0F, 9.0F), 1.0, NormalChannels::xy); });
    EXPECT_TRUE(test::says(error, "longer than a unit vector"));
  }
  // Slopes of one sign alone are normals as they are.
  EXPECT_NO_THROW((void)decode_unit_normals(one_texel({0.3F, 0.0F})));
  EXPECT_NO_THROW((void)decode_unit_normals(one_texel({0.1F, 0.2F})));
}

TEST(SurfaceMaps, FloatsOfOtherFormatsMustBeEncoded) {
  Image unit(2, 1, 3), encoded(2, 1, 3);
  unit.texels = {0.6F, 0.0F, 0.8F, 0.0F, 0.0F, 1.0F};
  std::ranges::transform(unit.texels, encoded.texels.begin(), [](float value) { return 0.5F * value + 0.5F; });
  EXPECT_NO_THROW(require_encoded_normals(encoded, NormalChannels::xyz));
  EXPECT_THROW(require_encoded_normals(unit, NormalChannels::xyz), Error);
  EXPECT_NO_THROW(require_encoded_normals(bumps_xy(2, 0.5F, 0.5F), NormalChannels::xyz));
  EXPECT_THROW(require_encoded_normals(bumps_xy(2, 0.0F, 1.0F), NormalChannels::xyz), Error);
}

TEST(SurfaceMaps, FloatsOutOfRangeAreNamed) {
  const auto lines = [](Image image, bool floats, std::span<const std::size_t> channels) {
    return describe_unit_values({.image = std::move(image), .floats = floats}, channels, "gloss.exr");
  };
  Image map(2, 1, 3, 0.5F);
  map.texels = {9.0F, 0.5F, 0.0F, 9.0F, 0.25F, 1.0F};
  EXPECT_TRUE(lines(map, true, roughness_channels).empty()) << "red does not count";
  ASSERT_EQ(lines(map, true, color_channels).size(), 1U);
  EXPECT_TRUE(test::says(lines(map, true, color_channels)[0], "`gloss.exr`: 2 values are outside of 0 to 1 (0 to 9)"));
  map.texels[1] = std::numeric_limits<float>::quiet_NaN();
  map.texels[4] = -0.5F;
  ASSERT_EQ(lines(map, true, roughness_channels).size(), 2U);
  EXPECT_TRUE(test::says(lines(map, true, roughness_channels)[0], "1 values are not finite"));
  EXPECT_TRUE(test::says(lines(map, true, roughness_channels)[1], "(-0.5 to 1)"));
  EXPECT_TRUE(test::says(lines(Image(2, 2, 1, 0.5F), true, roughness_channels).at(0), "the same value"));
  EXPECT_TRUE(lines(Image(1, 1, 1, 0.5F), true, roughness_channels).empty());
  EXPECT_TRUE(lines(Image(2, 2, 1, 0.5F), false, roughness_channels).empty()) << "integers are in range";
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
