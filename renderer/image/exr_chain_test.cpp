// Mip-mapped EXR files: read back by OpenEXR itself and by the reader beside the writer, and refused where they are
// none.
#include "renderer/image/image_io.hpp"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfTiledInputFile.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <stdexcept>

#include "renderer/core/error.hpp"
#include "renderer/image/mipmap.hpp"
#include "tests/support/fresh_folder.hpp"

namespace footprint {
namespace {

namespace fs = std::filesystem;

// Halves represent every value.
std::vector<Image> uneven_chain(int width, int height, int channels) {
  Image finest(width, height, channels);
  for (std::size_t i = 0; i < finest.texels.size(); ++i) finest.texels[i] = static_cast<float>(i % 64) - 20.0F;
  std::vector<Image> chain = mip_chain(std::move(finest));
  for (Image& level : chain) {
    for (float& value : level.texels) value = std::round(8.0F * value) / 8.0F;
  }
  return chain;
}

// A channel of a level, by OpenEXR alone.
std::vector<float> level_of(const fs::path& file, const char* channel, int level) {
  Imf::TiledInputFile input(file.c_str());
  const Imath::Box2i window = input.dataWindowForLevel(level);
  const auto width = static_cast<std::size_t>(window.max.x + 1), height = static_cast<std::size_t>(window.max.y + 1);
  std::vector<float> values(width * height, -999.0F);
  Imf::FrameBuffer buffer;
  buffer.insert(channel,
                Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), sizeof(float), sizeof(float) * width));
  input.setFrameBuffer(buffer);
  input.readTiles(0, input.numXTiles(level) - 1, 0, input.numYTiles(level) - 1, level);
  return values;
}

std::vector<float> channel_values(const Image& image, std::size_t channel) {
  std::vector<float> values;
  for (std::size_t i = channel; i < image.texels.size(); i += static_cast<std::size_t>(image.channels))
    values.push_back(image.texels[i]);
  return values;
}

TEST(ExrChain, IsAMipMappedFileToOpenExr) {
  const fs::path file = test::fresh_folder() / "map.exr";
  const std::vector<Image> chain = uneven_chain(37, 130, 3);
  write_exr_chain(file, {.levels = chain, .channels = {"R", "G", "B"}}, ExrTexel::full);
  const Imf::TiledInputFile input(file.c_str());
  EXPECT_EQ(input.levelMode(), Imf::MIPMAP_LEVELS);
  EXPECT_EQ(input.levelRoundingMode(), Imf::ROUND_DOWN);
  EXPECT_EQ(input.header().channels().findChannel("G")->type, Imf::FLOAT);
  ASSERT_EQ(input.numLevels(), static_cast<int>(chain.size()));
  for (std::size_t level = 0; level < chain.size(); ++level) {
    EXPECT_EQ(level_of(file, "R", static_cast<int>(level)), channel_values(chain[level], 0)) << level;
    EXPECT_EQ(level_of(file, "B", static_cast<int>(level)), channel_values(chain[level], 2)) << level;
  }
}

TEST(ExrChain, StoresHalves) {
  const fs::path file = test::fresh_folder() / "map.exr";
  const std::vector<Image> chain = uneven_chain(8, 8, 1);
  write_exr_chain(file, {.levels = chain, .channels = {"Y"}}, ExrTexel::half);
  EXPECT_EQ(Imf::TiledInputFile(file.c_str()).header().channels().findChannel("Y")->type, Imf::HALF);
  EXPECT_EQ(read_exr_chain(file).levels, chain);
}

TEST(ExrChain, ComesBackWithItsNames) {
  const fs::path folder = test::fresh_folder();
  for (const std::vector<std::string>& names :
       {std::vector<std::string>{"R", "G"}, {"R", "G", "B", "A"}, {"m0", "m1", "m2", "m3", "m4", "m5"}}) {
    const std::vector<Image> chain = uneven_chain(65, 3, static_cast<int>(names.size()));
    write_exr_chain(folder / "map.exr", {.levels = chain, .channels = names}, ExrTexel::full);
    const ExrChain back = read_exr_chain(folder / "map.exr");
    EXPECT_EQ(back.levels, chain);
    EXPECT_EQ(back.channels, names);
  }
}

TEST(ExrChain, TakesTheFinestLevelAlone) {
  const fs::path file = test::fresh_folder() / "map.exr";
  const std::vector<Image> finest{uneven_chain(5, 9, 4).front()};
  write_exr_chain(file, {.levels = finest, .channels = {"R", "G", "B", "A"}}, ExrTexel::full);
  EXPECT_EQ(read_exr_chain(file).levels, finest);
  EXPECT_EQ(read_image(file, Transfer::linear), finest.front());
}

TEST(ExrChain, EqualChainsAreEqualFiles) {
  const fs::path folder = test::fresh_folder();
  for (const char* name : {"a.exr", "b.exr"})
    write_exr_chain(folder / name, {.levels = uneven_chain(16, 16, 1), .channels = {"Y"}}, ExrTexel::full);
  const auto bytes = [&](const char* name) {
    std::ifstream stream(folder / name, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(stream), {});
  };
  EXPECT_EQ(bytes("a.exr"), bytes("b.exr"));
}

TEST(ExrChain, RefusesWhatIsNoChain) {
  const fs::path file = test::fresh_folder() / "map.exr";
  std::vector<Image> chain = uneven_chain(8, 8, 1);
  EXPECT_THROW(write_exr_chain(file, {.levels = {}, .channels = {}}, ExrTexel::full), std::logic_error);
  EXPECT_THROW(write_exr_chain(file, {.levels = chain, .channels = {"R", "G"}}, ExrTexel::full), std::logic_error);
  chain.pop_back();
  EXPECT_THROW(write_exr_chain(file, {.levels = chain, .channels = {"Y"}}, ExrTexel::full), std::logic_error);
  chain.push_back(Image(2, 1, 1));
  EXPECT_THROW(write_exr_chain(file, {.levels = chain, .channels = {"Y"}}, ExrTexel::full), std::logic_error);
  EXPECT_FALSE(fs::exists(file));
}

TEST(ExrChain, RefusesToReadWhatIsNoMap) {
  const fs::path folder = test::fresh_folder();
  EXPECT_THROW((void)read_exr_chain(folder / "missing.exr"), Error);
  std::ofstream(folder / "text.exr") << "no image";
  EXPECT_THROW((void)read_exr_chain(folder / "text.exr"), Error);
  write_exr_chain(folder / "map.exr", {.levels = uneven_chain(64, 64, 3), .channels = {"R", "G", "B"}}, ExrTexel::full);
  EXPECT_THROW((void)read_exr_chain(folder / "map.exr", 2), Error);
  fs::resize_file(folder / "map.exr", fs::file_size(folder / "map.exr") / 2);
  EXPECT_THROW((void)read_exr_chain(folder / "map.exr"), Error);
}

}  // namespace
}  // namespace footprint
