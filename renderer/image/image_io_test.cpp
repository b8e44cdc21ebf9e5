// Pictures in and out: PNG files made byte by byte, EXR files read back by OpenEXR itself, the sRGB curve.
#include "renderer/image/image_io.hpp"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfStringAttribute.h>
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <numeric>

#include "renderer/core/error.hpp"
#include "tests/support/fresh_folder.hpp"
#include "tests/support/image_files.hpp"
#include "tests/support/png_file.hpp"

namespace footprint {
namespace {

namespace fs = std::filesystem;
using namespace std::string_literals;
using test::expect_texels;
using test::fresh_folder;
using test::PngColor;

std::vector<std::uint8_t> bytes_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

Image gradient(int channels) {
  Image image(5, 3, channels);
  std::iota(image.texels.begin(), image.texels.end(), 0.0F);
  for (float& value : image.texels) value = value / 7.0F - 0.5F;
  return image;
}

TEST(ReadImage, PaletteBecomesColours) {
  const std::string palette = test::png_chunk("PLTE",
                                              "\xff\0\0"
                                              "\0\x80\0"
                                              "\0\0\x40"
                                              "\x33\x66\x99"s);
  const auto file = test::png_file(2, 2, 8, PngColor::palette,
                                   "\0\0\1"
                                   "\0\2\3"s,
                                   palette);
  const Image image = read_image(file, "palette", Transfer::linear);
  ASSERT_EQ(image.channels, 3);
  expect_texels(image, {1, 0, 0, 0, 128 / 255.0, 0, 0, 0, 64 / 255.0, 0.2, 0.4, 0.6});
}

TEST(ReadImage, PaletteTransparencyBecomesAlpha) {
  const std::string chunks = test::png_chunk("PLTE",
                                             "\xff\0\0"
                                             "\0\xff\0"s) +
                             test::png_chunk("tRNS", std::string(1, '\x33'));
  const auto file = test::png_file(2, 1, 8, PngColor::palette, "\0\0\1"s, chunks);
  expect_texels(read_image(file, "palette", Transfer::linear), {1, 0, 0, 0.2, 0, 1, 0, 1});
}

TEST(ReadImage, SixteenBitsStay) {
  const auto file = test::png_file(2, 1, 16, PngColor::gray, "\0\x80\x01\xff\xff"s);
  const Image image = read_image(file, "gray16", Transfer::linear);
  ASSERT_EQ(image.channels, 1);
  expect_texels(image, {32769 / 65535.0, 1});
}

TEST(ReadImage, OneBitGray) {
  const auto file = test::png_file(4, 1, 1, PngColor::gray, "\0\x50"s);
  expect_texels(read_image(file, "gray1", Transfer::linear), {0, 1, 0, 1});
}

// Colours under alpha 0 and 0.2 come back as stored, not premultiplied; alpha has no transfer curve.
TEST(ReadImage, AlphaIsNeverPremultiplied) {
  const auto rgba = test::png_file(2, 1, 8, PngColor::rgba, "\0\xff\x80\0\x33\x0a\x14\x1e\0"s);
  expect_texels(read_image(rgba, "rgba", Transfer::linear),
                {1, 128 / 255.0, 0, 0.2, 10 / 255.0, 20 / 255.0, 30 / 255.0, 0});
  const auto gray_alpha = test::png_file(2, 1, 8, PngColor::gray_alpha, "\0\xc8\0\x64\x80"s);
  expect_texels(read_image(gray_alpha, "gray-alpha", Transfer::linear), {200 / 255.0, 0, 100 / 255.0, 128 / 255.0});
}

// IEC 61966-2-1: 0.5 -> 0.214041, 0.04 -> 0.04 / 12.92.
TEST(ReadImage, SrgbDecodesColoursAndLeavesAlpha) {
  const auto file = test::png_file(1, 1, 16, PngColor::rgba, "\0\x80\0\x0a\x3d\xff\xff\x80\0"s);
  const Image image = read_image(file, "rgba16", Transfer::srgb);
  EXPECT_NEAR(image.texels[0], 0.214044, 1e-5);
  EXPECT_NEAR(image.texels[1], 0x0a3d / 65535.0 / 12.92, 1e-7);
  EXPECT_NEAR(image.texels[2], 1, 1e-6);
  EXPECT_NEAR(image.texels[3], 0x8000 / 65535.0, 1e-6);
}

TEST(ReadImage, SrgbLeavesFloatFilesAlone) {
  const fs::path file = fresh_folder() / "float.exr";
  write_exr(file, gradient(3));
  EXPECT_EQ(read_image(file, Transfer::srgb), gradient(3));
}

TEST(ReadImage, JpegIsRecognisedByItsBytesNotItsName) {
  const fs::path folder = fresh_folder();
  const std::vector<std::uint8_t> gray(std::size_t{16} * 16 * 3, 100);
  const auto output = OIIO::ImageOutput::create("jpeg");
  ASSERT_TRUE(output->open((folder / "gray.jpg").string(), {16, 16, 3, OIIO::TypeDesc::UINT8}));
  ASSERT_TRUE(output->write_image(OIIO::TypeDesc::UINT8, gray.data()));
  ASSERT_TRUE(output->close());
  fs::rename(folder / "gray.jpg", folder / "gray.png");
  const Image image = read_image(folder / "gray.png", Transfer::linear);
  ASSERT_EQ(image.channels, 3);
  ASSERT_EQ(image.width, 16);
  for (const float value : image.texels) ASSERT_NEAR(value, 100 / 255.0, 1.5 / 255);
}

TEST(ReadImage, EveryKindThatTheErrorsNameIsRead) {
  const fs::path folder = fresh_folder();
  const std::vector<float> texels(std::size_t{8} * 8 * 3, 0.25F);
  for (const std::string extension : {"png", "jpg", "exr", "hdr", "tif", "bmp", "webp"}) {
    const fs::path file = folder / ("image." + extension);
    test::write_by_library(file, {8, 8, 3, OIIO::TypeDesc::FLOAT}, texels);
    for (const Image& image :
         {read_image(file, Transfer::linear), read_image(bytes_of(file), "memory", Transfer::linear)}) {
      ASSERT_EQ(image.texels.size(), texels.size()) << extension;
      for (const float value : image.texels) ASSERT_NEAR(value, 0.25, 0.01) << extension;
    }
  }
}

class ExrChannels : public testing::TestWithParam<int> {};

TEST_P(ExrChannels, ComeBackBitForBit) {
  const fs::path file = fresh_folder() / "image.exr";
  Image image = gradient(GetParam());
  image.texels[0] = 1e30F;
  image.texels[1] = -1e-30F;
  write_exr(file, image);
  EXPECT_EQ(read_image(file, Transfer::linear), image);
  EXPECT_EQ(read_image(bytes_of(file), "memory", Transfer::linear), image);
}

INSTANTIATE_TEST_SUITE_P(WriteExr, ExrChannels, testing::Values(1, 3, 4));

// OpenEXR's own reader finds the usual channel names, 32-bit float, row 0 at the top.
TEST(WriteExr, OpenExrReadsIt) {
  const fs::path file = fresh_folder() / "rgba.exr";
  const Image image = gradient(4);
  write_exr(file, image);
  Imf::InputFile input(file.c_str());
  std::vector<std::string> names;
  for (auto channel = input.header().channels().begin(); channel != input.header().channels().end(); ++channel) {
    names.emplace_back(channel.name());
    EXPECT_EQ(channel.channel().type, Imf::FLOAT);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"A", "B", "G", "R"}));
  EXPECT_EQ(input.header().compression(), Imf::ZIP_COMPRESSION);
  std::vector<float> green(image.texel_count());
  Imf::FrameBuffer frame;
  frame.insert("G", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(green.data()), sizeof(float), 5 * sizeof(float)));
  input.setFrameBuffer(frame);
  input.readPixels(0, 2);
  for (std::size_t i = 0; i < green.size(); ++i) EXPECT_EQ(green[i], image.texels[4 * i + 1]);
}

TEST(WriteExr, OneChannelIsLuminance) {
  const fs::path file = fresh_folder() / "y.exr";
  write_exr(file, gradient(1));
  const Imf::InputFile input(file.c_str());
  EXPECT_NE(input.header().channels().findChannel("Y"), nullptr);
}

TEST(WriteExr, NotANumberComesBackAsWritten) {
  const fs::path file = fresh_folder() / "nan.exr";
  Image image(2, 1, 3, 1.0F);
  image.texels[1] = std::numeric_limits<float>::quiet_NaN();
  image.texels[4] = std::numeric_limits<float>::infinity();
  EXPECT_THROW(write_exr(file, image), Error);
  const Image back = read_image(file, Transfer::linear);
  EXPECT_TRUE(std::isnan(back.texels[1]));
  EXPECT_EQ(back.texels[4], std::numeric_limits<float>::infinity());
}

TEST(WriteImage, TheSamePictureIsTheSameBytes) {
  const fs::path folder = fresh_folder();
  for (const std::string extension : {"exr", "png"}) {
    const auto write = extension == "exr" ? write_exr : write_png;
    write(folder / ("a." + extension), gradient(4));
    write(folder / ("b." + extension), gradient(4));
    const std::vector<std::uint8_t> bytes = bytes_of(folder / ("a." + extension));
    EXPECT_EQ(bytes, bytes_of(folder / ("b." + extension)));
  }
}

// A date in the file would make equal pictures differ from second to second.
TEST(WriteExr, BearsNoDate) {
  const fs::path file = fresh_folder() / "undated.exr";
  write_exr(file, gradient(4));
  const Imf::InputFile input(file.c_str());
  const auto* date = input.header().findTypedAttribute<Imf::StringAttribute>("capDate");
  EXPECT_TRUE(date == nullptr || date->value().empty()) << date->value();
}

TEST(WriteImage, LeavesNothingButTheFile) {
  const fs::path folder = fresh_folder();
  write_exr(folder / "a.exr", gradient(3));
  write_png(folder / "a.png", gradient(3));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 2);
}

TEST(WriteImage, AFolderThatIsNotThereIsTheMachinesError) {
  const fs::path file = fresh_folder() / "absent" / "a.exr";
  try {
    write_exr(file, gradient(3));
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::machine);
    EXPECT_EQ(error.place(), file.string());
  }
}

TEST(WriteImage, PicturesThatNoFormatTakesAreRefused) {
  const fs::path file = fresh_folder() / "a.png";
  EXPECT_THROW(write_png(file, Image(2, 2, 2)), Error);
  EXPECT_THROW(write_png(file, Image()), Error);
  EXPECT_THROW(write_exr(file, Image(2, 2, 5)), Error);
  EXPECT_FALSE(fs::exists(file));
}

TEST(WritePng, RoundsAndClamps) {
  const fs::path file = fresh_folder() / "a.png";
  Image image(3, 1, 3);
  image.texels = {0.0F, 1.0F, 2.0F, -1.0F, std::numeric_limits<float>::quiet_NaN(), 0.5F, 100 / 255.0F, 0.2F, 0.6F};
  EXPECT_THROW(write_png(file, image), Error) << "NaN is written as 0, and named";
  expect_texels(read_image(file, Transfer::linear), {0, 1, 1, 0, 0, 128 / 255.0, 100 / 255.0, 0.2, 0.6});
}

TEST(WritePng, ColoursUnderAlphaStayAsTheyAre) {
  const fs::path file = fresh_folder() / "a.png";
  Image image(2, 1, 4);
  image.texels = {1.0F, 0.6F, 0.2F, 0.2F, 0.4F, 0.2F, 0.0F, 0.0F};
  write_png(file, image);
  expect_texels(read_image(file, Transfer::linear), {1, 0.6, 0.2, 0.2, 0.4, 0.2, 0, 0});
}

TEST(ToDisplay, ExposesClampsAndEncodes) {
  Image radiance(3, 1, 4);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  radiance.texels = {0.10702057F, 0.001F, 9.0F, 1.0F, -1.0F, nan, 0.25F, 0.5F, 5.0F, 5.0F, 5.0F, 0.0F};
  Image display = to_display(radiance, 2.0F);
  EXPECT_TRUE(std::isnan(display.texels[5]));  // for write_png to see
  display.texels[5] = 0.0F;
  expect_texels(display, {0.5, 0.002 * 12.92, 1, 1, 0, 0, 0.735357, 0.5, 0, 0, 0, 0});
}

TEST(FilesNotFinite, AreWrittenAndNamedByEveryWriter) {
  const fs::path folder = fresh_folder();
  Image image(3, 2, 4, 0.5F);
  const auto write_all = [&](const std::string& stem) {
    const std::vector<std::function<void()>> writers{
        [&] { write_exr(folder / (stem + ".exr"), image); },
        [&] { write_png(folder / (stem + ".png"), to_display(image, 1.0F)); },
        [&] {
          write_exr_chain(folder / (stem + "_chain.exr"), {.levels = {image}, .channels = {"R", "G", "B", "A"}},
                          ExrTexel::full);
        }};
    std::vector<std::string> errors;
    for (const auto& write : writers) {
      try {
        write();
      } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::check);
        errors.emplace_back(error.what());
      }
    }
    return errors;
  };
  EXPECT_TRUE(write_all("fine").empty());
  image.at(1, 0)[0] = image.at(1, 0)[2] = std::numeric_limits<float>::quiet_NaN();
  image.at(2, 1)[1] = std::numeric_limits<float>::infinity();
  const std::vector<std::string> errors = write_all("broken");
  ASSERT_EQ(errors.size(), 3U);
  const std::array<std::string, 3> names{"broken.exr", "broken.png", "broken_chain.exr"};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(errors[i], (folder / names.at(i)).string() + ": 2 of 6 pixels are not finite");
    EXPECT_TRUE(fs::exists(folder / names.at(i)));
  }
}

// Encoding and decoding are inverses over all 8-bit codes.
TEST(ToDisplay, InvertsTheDecodingOfSrgb) {
  const fs::path file = fresh_folder() / "codes.png";
  Image codes(256, 1, 1);
  for (int x = 0; x < 256; ++x) codes.at(x, 0)[0] = static_cast<float>(x) / 255.0F;
  write_png(file, codes);
  const Image display = to_display(read_image(file, Transfer::srgb), 1.0F);
  for (int x = 0; x < 256; ++x) EXPECT_NEAR(display.at(x, 0)[0], codes.at(x, 0)[0], 1e-5);
}

}  // namespace
}  // namespace footprint
