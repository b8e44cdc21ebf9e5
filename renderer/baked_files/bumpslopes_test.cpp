// LEAN's moments against the file that OpenImageIO itself makes of the same map, both ways.
#include "renderer/baked_files/baked_files.hpp"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "renderer/bake/normal_chain.hpp"
#include "renderer/bake/slope_moments.hpp"
#include "renderer/core/error.hpp"
#include "renderer/scene/assembly/surface_maps.hpp"
#include "tests/support/fresh_folder.hpp"
#include "tests/support/says.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing {
namespace {

namespace fs = std::filesystem;

// What `maketx --bumpslopes --bumpformat FORMAT -d float` makes of a picture.
fs::path made_by_openimageio(const Image& picture, const char* format) {
  const fs::path file = test::fresh_folder() / "slopes.exr";
  OIIO::ImageBuf buffer(OIIO::ImageSpec(picture.width, picture.height, picture.channels, OIIO::TypeDesc::FLOAT),
                        const_cast<float*>(picture.texels.data()));
  OIIO::ImageSpec config;
  config.attribute("maketx:bumpformat", format);
  config.set_format(OIIO::TypeDesc::FLOAT);
  std::ostringstream messages;
  EXPECT_TRUE(OIIO::ImageBufAlgo::make_texture(OIIO::ImageBufAlgo::MakeTxBumpWithSlopes, buffer, file.string(), config,
                                               &messages))
      << messages.str() << OIIO::geterror();
  return file;
}

Image without_weight(const Image& normals) {
  Image out(normals.width, normals.height, 3);
  for (std::size_t i = 0; i < out.texel_count(); ++i) std::copy_n(&normals.texels[4 * i], 3, &out.texels[3 * i]);
  return out;
}

Prefiltered lean_of(const Image& normals, const StoredSlopes& stored = {}) {
  const Material material = square_scene(normals, {}).materials.front();
  const Options options({float_storage_option(), slope_roughness_option(), steepest_slope_option()}, {}, "lean");
  EffectSet effects;
  effects.set(static_cast<std::size_t>(Effect::normal_variation));
  return bake_slopes(material, options, effects, stored);
}

void expect_alike(const std::vector<Image>& a, const std::vector<Image>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t level = 0; level < a.size(); ++level) {
    ASSERT_EQ(a[level].texels.size(), b[level].texels.size()) << level;
    for (std::size_t i = 0; i < a[level].texels.size(); ++i)
      ASSERT_NEAR(a[level].texels[i], b[level].texels[i], 1e-5) << "level " << level << ", number " << i;
  }
}

TEST(Bumpslopes, AreThoseOfOpenImageIO) {
  const Image normals = random_normals(64, 32, 0.7F, 4);  // slopes below 1: none is cut off
  const ExrChain theirs = read_exr_chain(made_by_openimageio(without_weight(normals), "normal"));
  const ExrChain ours = make_bumpslopes(lean_of(normals)).value();
  EXPECT_EQ(ours.channels, theirs.channels);
  expect_alike(ours.levels, theirs.levels);
}

TEST(Bumpslopes, OfOpenImageIOBecomeLeansMaps) {
  const Image normals = random_normals(32, 32, 0.7F, 5);
  const ExrChain theirs = read_exr_chain(made_by_openimageio(without_weight(normals), "normal"));
  const Prefiltered expected = lean_of(normals);
  Prefiltered taken = lean_of(normals_of_bumpslopes(theirs, "theirs"));
  for (PrefilteredTexture& texture : taken.textures) {
    for (TextureLevel& level : texture.levels) std::ranges::fill(level.bytes, 0);
  }
  replace_moments(theirs, taken);
  for (std::size_t t = 0; t < expected.textures.size(); ++t) {
    for (std::size_t level = 0; level < expected.textures[t].levels.size(); ++level)
      expect_alike({decode_level(taken.textures[t], level)}, {decode_level(expected.textures[t], level)});
  }
}

// The mean normal is behind the mixed moment, and is not part of the layout.
TEST(Bumpslopes, LeaveTheMeanNormal) {
  const StoredSlopes with_normal{.variant = SlopeVariant::full, .mean_normal = true};
  const Prefiltered own = lean_of(random_normals(16, 16, 0.5F, 1), with_normal);
  const Prefiltered other = lean_of(random_normals(16, 16, 0.5F, 2), with_normal);
  Prefiltered taken = own;
  replace_moments(make_bumpslopes(other).value(), taken);
  EXPECT_EQ(taken.textures[0], other.textures[0]);
  const Image rest = decode_level(taken.textures[1], 0);
  const Image expected_cross = decode_level(other.textures[1], 0), expected_normal = decode_level(own.textures[1], 0);
  for (std::size_t i = 0; i < rest.texels.size(); ++i)
    ASSERT_EQ(rest.texels[i], (i % 4 == 0 ? expected_cross : expected_normal).texels[i]) << i;
}

// A ramp that falls along u and rises down the rows: its normal leans to +u and, green up, to +v.
TEST(Bumpslopes, OfHeightsAreTurnedRound) {
  Image heights(16, 16, 1);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x)
      heights.at(x, y)[0] = 5.0F - 0.2F * static_cast<float>(x) + 0.1F * static_cast<float>(y);
  }
  const ExrChain chain = read_exr_chain(made_by_openimageio(heights, "height"));
  const Image normals = normals_of_bumpslopes(chain, "heights");
  const double length = std::sqrt(1.0 + 0.2 * 0.2 + 0.1 * 0.1);
  EXPECT_NEAR(normals.at(8, 8)[0], 0.2 / length, 1e-5);
  EXPECT_NEAR(normals.at(8, 8)[1], 0.1 / length, 1e-5);
  EXPECT_NEAR(normals.at(8, 8)[2], 1.0 / length, 1e-5);
  Prefiltered taken = lean_of(random_normals(16, 16, 0.5F, 1));
  replace_moments(chain, taken);
  EXPECT_NEAR(decode_level(taken.textures[0], 0).at(8, 8)[1], -0.1, 1e-5);  // the slope along v
  EXPECT_NEAR(decode_level(taken.textures[1], 0).at(8, 8)[0], 0.02, 1e-5);  // -0.2 x -0.1
}

// Both by Sobel's filter, ours in widths of the map. OpenImageIO takes the border for black.
TEST(Bumpslopes, OfHeightsAreThoseOfOurSobelFilter) {
  constexpr int size = 24;
  Image heights(size, size, 1);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x)
      heights.at(x, y)[0] = static_cast<float>(std::sin(0.7 * x) + std::cos(0.4 * y + 0.2 * x));
  }
  const ExrChain chain = read_exr_chain(made_by_openimageio(heights, "height"));
  const Image theirs = normals_of_bumpslopes(chain, "heights");
  const Image ours = normals_of_heights(heights, 1.0 / size, {.filter = SlopeFilter::sobel});
  for (int y = 1; y + 1 < size; ++y) {
    for (int x = 1; x + 1 < size; ++x) {
      for (std::size_t c = 0; c < 3; ++c) ASSERT_NEAR(ours.at(x, y)[c], theirs.at(x, y)[c], 1e-6) << x << " " << y;
    }
  }
}

TEST(Bumpslopes, OfAnotherLayoutAreRefused) {
  const auto refusal = [](const ExrChain& chain) {
    try {
      (void)normals_of_bumpslopes(chain, "map.exr");
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::usage);
      return std::string(error.what());
    }
    return std::string("no error");
  };
  ExrChain chain = make_bumpslopes(lean_of(random_normals(8, 8, 0.5F, 1))).value();
  EXPECT_EQ(refusal(chain), "no error");
  ExrChain other = chain;
  other.channels = {"R", "G", "B", "A", "X", "Y"};
  EXPECT_TRUE(test::says(refusal(other), "map.exr: has the channels R, G"));
  other = chain;
  other.levels.resize(1);
  EXPECT_TRUE(test::says(refusal(other), "has 1 of 4 mip levels"));
  other = chain;
  other.levels[2].texels[3] = std::nanf("");
  EXPECT_TRUE(test::says(refusal(other), "level 2x2"));
}

TEST(Bumpslopes, AreNotInOtherBakes) {
  Prefiltered other = lean_of(random_normals(8, 8, 0.5F, 1));
  other.textures.pop_back();
  EXPECT_FALSE(make_bumpslopes(other).has_value());
  EXPECT_FALSE(holds_slope_moments(other));
}

}  // namespace
}  // namespace footprint::testing
