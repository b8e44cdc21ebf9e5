// KTX2 files against a reader that was written from the specification, and the descriptor against its printed examples.
#include "renderer/baked_files/baked_files.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <utility>

#include "renderer/core/error.hpp"
#include "renderer/image/mipmap.hpp"
#include "tests/support/ktx2_reader.hpp"
#include "tests/support/says.hpp"

namespace footprint {
namespace {

using test::Ktx2File;
using test::read_ktx2;

std::vector<Image> counted_chain(int width, int height, int channels) {
  Image finest(width, height, channels);
  for (std::size_t i = 0; i < finest.texels.size(); ++i) finest.texels[i] = static_cast<float>(i % 251) / 251.0F;
  return mip_chain(std::move(finest));
}

TEST(Ktx2, HoldsEveryStorageAndCountOfChannels) {
  for (const Storage storage : {Storage::fp32, Storage::fp16, Storage::unorm8}) {
    for (int channels = 1; channels <= 4; ++channels) {
      const PrefilteredTexture texture = make_texture("map", counted_chain(13, 6, channels), storage, {});
      const Ktx2File file = read_ktx2(ktx2_bytes(texture));
      EXPECT_EQ(file.width, 13U);
      EXPECT_EQ(file.height, 6U);
      EXPECT_EQ(file.layers, 0U);
      ASSERT_EQ(file.levels.size(), texture.levels.size());
      for (std::size_t level = 0; level < file.levels.size(); ++level) {
        EXPECT_EQ(file.levels[level].bytes, texture.levels[level].bytes);
        EXPECT_EQ(static_cast<int>(file.levels[level].width), texture.levels[level].width);
      }
    }
  }
}

TEST(Ktx2, HoldsArraysLayerAfterLayer) {
  const std::vector<std::vector<Image>> layers{counted_chain(8, 8, 3), mip_chain(Image(8, 8, 3, 0.25F))};
  const PrefilteredTexture texture = make_array_texture("lobes", layers, Storage::fp16, {});
  const Ktx2File file = read_ktx2(ktx2_bytes(texture));
  EXPECT_EQ(file.layers, 2U);
  for (std::size_t level = 0; level < file.levels.size(); ++level)
    EXPECT_EQ(file.levels[level].bytes, texture.levels[level].bytes);
}

// KDFS 1.3, tables of BC1, BC4 and BC5: 4 x 4 texels, 64 bits a sample, 0 to the largest word.
TEST(Ktx2, DescribesBlocks) {
  const auto descriptor = [](int channels, Storage storage) {
    const PrefilteredTexture texture = make_texture("map", counted_chain(13, 6, channels), storage, {});
    const Ktx2File file = read_ktx2(ktx2_bytes(texture));
    EXPECT_EQ(file.type_size, 1U);
    for (std::size_t level = 0; level < file.levels.size(); ++level)
      EXPECT_EQ(file.levels[level].bytes, texture.levels[level].bytes);
    return file.descriptor;
  };
  constexpr std::uint32_t most = 0xFFFFFFFF, bits = 63U << 16U;
  EXPECT_EQ(descriptor(3, Storage::bc1),
            (std::vector<std::uint32_t>{44, 0, 40U << 16U | 2, 128 | 1U << 16U, 0x303, 8, 0, bits, 0, 0, most}));
  EXPECT_EQ(descriptor(1, Storage::bc4),
            (std::vector<std::uint32_t>{44, 0, 40U << 16U | 2, 131 | 1U << 16U, 0x303, 8, 0, bits, 0, 0, most}));
  EXPECT_EQ(descriptor(2, Storage::bc5),
            (std::vector<std::uint32_t>{60, 0, 56U << 16U | 2, 132 | 1U << 16U, 0x303, 16, 0, bits, 0, 0, most,
                                        64 | bits | 1U << 24U, 0, 0, most}));
}

// Numbers of vulkan_core.h.
TEST(Ktx2, NamesVulkansFormats) {
  EXPECT_EQ(vk_format(Storage::unorm8, 4), 37U);  // VK_FORMAT_R8G8B8A8_UNORM
  EXPECT_EQ(vk_format(Storage::unorm8, 1), 9U);   // VK_FORMAT_R8_UNORM
  EXPECT_EQ(vk_format(Storage::fp16, 4), 97U);    // VK_FORMAT_R16G16B16A16_SFLOAT
  EXPECT_EQ(vk_format(Storage::fp16, 3), 90U);    // VK_FORMAT_R16G16B16_SFLOAT
  EXPECT_EQ(vk_format(Storage::fp32, 4), 109U);   // VK_FORMAT_R32G32B32A32_SFLOAT
  EXPECT_EQ(vk_format(Storage::fp32, 2), 103U);   // VK_FORMAT_R32G32_SFLOAT
  EXPECT_EQ(vk_format(Storage::bc1, 3), 131U);    // VK_FORMAT_BC1_RGB_UNORM_BLOCK
  EXPECT_EQ(vk_format(Storage::bc4, 1), 139U);    // VK_FORMAT_BC4_UNORM_BLOCK
  EXPECT_EQ(vk_format(Storage::bc5, 2), 141U);    // VK_FORMAT_BC5_UNORM_BLOCK
}

TEST(Ktx2, DescribesItsTexels) {
  const Ktx2File bytes = read_ktx2(ktx2_bytes(make_texture("map", counted_chain(4, 4, 4), Storage::unorm8, {})));
  EXPECT_EQ(bytes.type_size, 1U);
  // KDFS 1.3: 92 bytes, RGBSDA, linear, one byte per channel from bit 0 on, alpha as channel 15, 0 to 255.
  EXPECT_EQ(bytes.descriptor, (std::vector<std::uint32_t>{92,
                                                          0,
                                                          88U << 16U | 2,
                                                          1 | 1U << 16U,
                                                          0,
                                                          4,
                                                          0,  //
                                                          0 | 7U << 16U,
                                                          0,
                                                          0,
                                                          255,
                                                          8 | 7U << 16U | 1U << 24U,
                                                          0,
                                                          0,
                                                          255,  //
                                                          16 | 7U << 16U | 2U << 24U,
                                                          0,
                                                          0,
                                                          255,
                                                          24 | 7U << 16U | 15U << 24U,
                                                          0,
                                                          0,
                                                          255}));
  const Ktx2File halves = read_ktx2(ktx2_bytes(make_texture("map", counted_chain(4, 4, 1), Storage::fp16, {})));
  EXPECT_EQ(halves.type_size, 2U);
  // One signed float of 16 bits; -1 and 1 as 32-bit floats.
  EXPECT_EQ(halves.descriptor, (std::vector<std::uint32_t>{44, 0, 40U << 16U | 2, 1 | 1U << 16U, 0, 2, 0,
                                                           15U << 16U | 0xC0U << 24U, 0, 0xBF800000, 0x3F800000}));
}

TEST(Ktx2, SaysWhichRowComesFirst) {
  const Ktx2File file = read_ktx2(ktx2_bytes(make_texture("map", counted_chain(2, 2, 1), Storage::fp32, {})));
  EXPECT_EQ(file.keys.at("KTXorientation"), std::string("rd\0", 3));
  EXPECT_EQ(file.keys.count("KTXwriter"), 1U);
}

TEST(Ktx2, TakesTheFinestLevelAlone) {
  const PrefilteredTexture texture = make_texture("map", {counted_chain(5, 7, 2).front()}, Storage::fp32, {});
  EXPECT_EQ(read_ktx2(ktx2_bytes(texture)).levels.size(), 1U);
}

// The texture without its texels, as a manifest describes it.
PrefilteredTexture form_of(PrefilteredTexture texture) {
  free_texels(texture);
  return texture;
}

std::vector<PrefilteredTexture> textures_of_every_kind() {
  std::vector<PrefilteredTexture> textures;
  for (const Storage storage : {Storage::fp32, Storage::fp16, Storage::unorm8}) {
    for (int channels = 1; channels <= 4; ++channels)
      textures.push_back(make_texture("map", counted_chain(13, 6, channels), storage, {}));
    textures.push_back(make_array_texture("lobes", {counted_chain(8, 4, 3), counted_chain(8, 4, 3)}, storage, {}));
  }
  for (const auto& [storage, channels] : {std::pair{Storage::bc1, 3}, {Storage::bc4, 1}, {Storage::bc5, 2}})
    textures.push_back(make_texture("map", counted_chain(13, 6, channels), storage, {}));
  textures.push_back(make_texture("map", {counted_chain(5, 7, 2).front()}, Storage::fp32, {}));
  return textures;
}

TEST(Ktx2Reading, GivesBackEveryTexture) {
  for (const PrefilteredTexture& texture : textures_of_every_kind()) {
    PrefilteredTexture again = form_of(texture);
    read_ktx2(ktx2_bytes(texture), again);
    EXPECT_EQ(again, texture);
  }
}

std::string refusal_of_file(const std::vector<std::uint8_t>& bytes, PrefilteredTexture form) {
  try {
    read_ktx2(bytes, form);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage) << error.what();
    EXPECT_FALSE(error.hint().empty()) << error.what();
    return error.what();
  }
  return "no error";
}

// A file is of one form alone: no other texture takes its texels.
TEST(Ktx2Reading, RefusesAnotherForm) {
  const std::vector<PrefilteredTexture> textures = textures_of_every_kind();
  for (const PrefilteredTexture& of_file : textures) {
    for (const PrefilteredTexture& form : textures) {
      const bool is_same = &form == &of_file;
      EXPECT_EQ(refusal_of_file(ktx2_bytes(of_file), form_of(form)) == "no error", is_same);
    }
  }
}

TEST(Ktx2Reading, RefusesEveryTruncation) {
  const PrefilteredTexture texture = make_texture("map", counted_chain(5, 3, 3), Storage::unorm8, {});
  const std::vector<std::uint8_t> whole = ktx2_bytes(texture);
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_NE(refusal_of_file({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)}, form_of(texture)),
              "no error")
        << size;
}

// Offsets and lengths near the largest number, where sums wrap around.
TEST(Ktx2Reading, RefusesWhatIsHostile) {
  const PrefilteredTexture texture = make_texture("map", counted_chain(4, 4, 4), Storage::fp32, {});
  const std::vector<std::uint8_t> whole = ktx2_bytes(texture);
  const auto with = [&](std::size_t at, std::size_t count, std::uint8_t value) {
    std::vector<std::uint8_t> bytes = whole;
    std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), count, value);
    return refusal_of_file(bytes, form_of(texture));
  };
  EXPECT_TRUE(test::says(with(0, 1, 0), "is not a KTX2 file"));
  EXPECT_TRUE(test::says(with(20, 4, 0xFF), "pixelWidth is 4294967295, and 4 was expected"));
  EXPECT_TRUE(test::says(with(40, 4, 0xFF), "levelCount"));
  EXPECT_TRUE(test::says(with(44, 1, 2), "supercompressionScheme is 2"));
  EXPECT_TRUE(test::says(with(48, 4, 0xFF), "descriptor is beyond the end"));
  EXPECT_TRUE(test::says(with(52, 4, 0), "descriptor is cut off"));
  EXPECT_TRUE(test::says(with(80, 8, 0xFF), "level 0 is beyond the end"));
  EXPECT_TRUE(test::says(with(88, 8, 0xFF), "byteLength of level 0"));
  const std::size_t descriptor = 80 + 24 * texture.levels.size();
  EXPECT_TRUE(test::says(with(descriptor + 14, 1, 2), "transfer function"));  // sRGB
  EXPECT_TRUE(test::says(with(descriptor + 20, 1, 4), "bytesPlane0"));
}

// The order and place of levels are the file's own: another program writes the finest first, behind keys of its own.
TEST(Ktx2Reading, TakesLevelsInAnyOrder) {
  const PrefilteredTexture texture = make_texture("map", counted_chain(4, 4, 1), Storage::fp32, {});
  std::vector<std::uint8_t> bytes = ktx2_bytes(texture);
  for (std::size_t level = 0; level < texture.levels.size(); ++level) {
    for (std::size_t i = 0; i < 8; ++i)
      bytes[80 + 24 * level + i] = static_cast<std::uint8_t>(std::uint64_t{bytes.size()} >> (8 * i));
    const auto& own = texture.levels[level].bytes;
    bytes.insert(bytes.end(), own.begin(), own.end());
  }
  PrefilteredTexture again = form_of(texture);
  read_ktx2(bytes, again);
  EXPECT_EQ(again, texture);
}

// The reader rejects wrong files, so that the tests above can fail.
TEST(Ktx2, TheReaderRefusesWrongFiles) {
  const std::vector<std::uint8_t> right = ktx2_bytes(make_texture("map", counted_chain(6, 6, 3), Storage::fp32, {}));
  ASSERT_NO_THROW((void)read_ktx2(right));
  for (const std::size_t at : {std::size_t{0}, std::size_t{28}, std::size_t{36}, std::size_t{44}, std::size_t{48},
                               std::size_t{80}, std::size_t{88}, std::size_t{96}}) {
    std::vector<std::uint8_t> wrong = right;
    wrong[at] ^= 0x01U;
    EXPECT_THROW((void)read_ktx2(wrong), std::runtime_error) << at;
  }
  EXPECT_THROW((void)read_ktx2(std::span(right).first(right.size() - 1)), std::runtime_error);
}

TEST(Ktx2, RefusesWhatHasNoTexels) {
  const PrefilteredTexture built = make_built_texture({.name = "built", .layers = 1}, {1, 1});
  EXPECT_THROW((void)ktx2_bytes(built), std::logic_error);
}

}  // namespace
}  // namespace footprint
