// What files declare about their texels, against values worked out by hand: orders of rows, windows, channels, colours,
// exposure, alpha.
#include "renderer/image/declarations.hpp"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <webp/encode.h>

#include <cmath>

#include "renderer/core/error.hpp"
#include "renderer/core/files.hpp"
#include "renderer/image/image_io.hpp"
#include "tests/support/fresh_folder.hpp"
#include "tests/support/image_files.hpp"
#include "tests/support/png_file.hpp"
#include "tests/support/says.hpp"

namespace footprint {
namespace {

namespace fs = std::filesystem;
using namespace std::string_literals;
using test::expect_texels;
using test::fresh_folder;
using test::PngColor;
using test::says;

std::vector<std::uint8_t> bytes_from(const std::string& text) { return {text.begin(), text.end()}; }

std::string refusal_of(const fs::path& file, Transfer transfer) {
  try {
    (void)read_image(file, transfer);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    EXPECT_FALSE(error.hint().empty());
    return error.what();
  }
  return "no error";
}

// A file of OpenImageIO's, whose texels count up from 0.
fs::path written(const std::string& name, const OIIO::ImageSpec& spec, float step = 1.0F) {
  const fs::path file = fresh_folder() / name;
  std::vector<float> texels(spec.image_pixels() * static_cast<std::size_t>(spec.nchannels));
  for (std::size_t i = 0; i < texels.size(); ++i) texels[i] = step * static_cast<float>(i);
  test::write_by_library(file, spec, texels);
  return file;
}

OIIO::ImageSpec spec_with(int width, int height, const std::vector<std::string>& channels,
                          OIIO::TypeDesc type = OIIO::TypeDesc::FLOAT) {
  OIIO::ImageSpec spec(width, height, static_cast<int>(channels.size()), type);
  spec.channelnames = channels;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    if (channels[c] == "A") spec.alpha_channel = static_cast<int>(c);
  }
  return spec;
}

// A mantissa is the middle of what it stands for: 128 is (128 + 1/2) of 256.
constexpr float grey_step = 1.0F + 1.0F / 256.0F;

// A Radiance HDR whose pixels are grey 1, 2, 4 ... in the order of the file, times `grey_step`.
std::vector<std::uint8_t> doubling_hdr(const std::string& lines, const std::string& size, int pixels) {
  std::string text = "#?RADIANCE\n" + lines + "\n" + size + "\n";
  for (int i = 0; i < pixels; ++i) text += "\x80\x80\x80"s + static_cast<char>(129 + i);
  return bytes_from(text);
}

const std::string rgbe = "FORMAT=32-bit_rle_rgbe\n";

// The picture is 2 wide and 3 tall, 1 2 / 4 8 / 16 32 in the usual order.
TEST(Declared, EveryOrderOfRadianceIsTurned) {
  struct Order {
    const char* size;
    std::vector<float> picture;
  };
  const std::vector<Order> orders{{"-Y 3 +X 2", {1, 2, 4, 8, 16, 32}}, {"-Y 3 -X 2", {2, 1, 8, 4, 32, 16}},
                                  {"+Y 3 +X 2", {16, 32, 4, 8, 1, 2}}, {"+Y 3 -X 2", {32, 16, 8, 4, 2, 1}},
                                  {"+X 2 -Y 3", {1, 8, 2, 16, 4, 32}}, {"+X 2 +Y 3", {4, 32, 2, 16, 1, 8}},
                                  {"-X 2 -Y 3", {8, 1, 16, 2, 32, 4}}, {"-X 2 +Y 3", {32, 4, 16, 2, 8, 1}}};
  for (const auto& [size, picture] : orders) {
    SCOPED_TRACE(size);
    for (const Transfer transfer : {Transfer::linear, Transfer::srgb, Transfer::declared}) {
      const Image image = read_image(doubling_hdr(rgbe, size, 6), size, transfer);
      ASSERT_EQ(image.width, 2);
      ASSERT_EQ(image.height, 3);
      for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(image.texels[3 * i], picture[i] * grey_step) << i;
    }
  }
}

TEST(Declared, MantissasOfRadianceAreTheMiddlesOfTheirSteps) {
  const auto file = bytes_from("#?RADIANCE\n" + rgbe + "\n-Y 1 +X 3\n" + "\xff\x80\x01\x80" +
                               std::string("\xc8\0\x0a\x89", 4) + std::string(4, '\0'));
  const float step = 2.0F;  // of the second pixel
  expect_texels(read_image(file, "steps", Transfer::declared),
                {255.5F / 256, 128.5F / 256, 1.5F / 256, 200.5F * step, 0.5F * step, 10.5F * step, 0, 0, 0}, 0.0F);
}

TEST(Declared, ExposuresOfRadianceMultiply) {
  const auto file = doubling_hdr("EXPOSURE=4.0\n" + rgbe + "COLORCORR=1 2 4\nEXPOSURE= 0.5\n", "-Y 1 +X 1", 1);
  expect_texels(read_image(file, "exposed", Transfer::declared),
                {grey_step / 2.0F, grey_step / 4.0F, grey_step / 8.0F});
}

// CIE XYZ of Rec. 709's white, and of its red: x = 0.64, y = 0.33, luminance 0.2126.
TEST(Declared, XyzeBecomesRec709) {
  const auto pixel = [](double x, double y, double z) {
    const auto mantissa = [](double value) { return static_cast<char>(std::lround(value * 128)); };
    return std::string{mantissa(x), mantissa(y), mantissa(z), '\x81'};
  };
  const std::string head = "#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 2\n";
  const auto file = bytes_from(head + pixel(0.9505, 1.0, 1.089) + pixel(0.4124, 0.2126, 0.0193));
  expect_texels(read_image(file, "xyz", Transfer::declared), {1, 1, 1, 1, 0, 0}, 0.02F);
  EXPECT_THROW((void)read_image(file, "xyz", Transfer::linear), Error) << "XYZ is no data";
}

TEST(Declared, DamagedRadianceHeadersAreRefused) {
  for (const std::string& lines : {"FORMAT=16-bit\n"s, rgbe + "EXPOSURE=0\n", rgbe + "EXPOSURE=many\n",
                                   rgbe + "COLORCORR=1 2\n", rgbe + "PRIMARIES=1 2 3\n"}) {
    EXPECT_THROW((void)read_image(doubling_hdr(lines, "-Y 1 +X 1", 1), "bad", Transfer::declared), Error) << lines;
  }
  for (const char* size : {"-Y 1 -Y 1", "-Y 1", "Y 1 X 1", "-Y 0 +X 1", "-Y 99999999999 +X 1"})
    EXPECT_THROW((void)read_image(doubling_hdr(rgbe, size, 1), "bad", Transfer::declared), Error) << size;
  const auto curved = doubling_hdr(rgbe + "GAMMA=2.2\n", "-Y 1 +X 1", 1);
  EXPECT_THROW((void)read_image(curved, "curved", Transfer::declared), Error);
  EXPECT_NO_THROW((void)read_image(doubling_hdr(rgbe + "GAMMA=1\n", "-Y 1 +X 1", 1), "linear", Transfer::declared));
}

// The published matrix of ACEScg (AP1, white of ACES) to Rec. 709 with Bradford's adaptation.
TEST(Declared, AcesColoursBecomeRec709) {
  Declarations declared;
  declared.chromaticities = Chromaticities{0.713, 0.293, 0.165, 0.83, 0.128, 0.044, 0.32168, 0.33767};
  const std::optional<glm::dmat3> matrix = rec709_from(declared, "file");
  ASSERT_TRUE(matrix);
  const std::array<std::array<double, 3>, 3> rows{
      {{1.70505, -0.62179, -0.08326}, {-0.13026, 1.14080, -0.01055}, {-0.02400, -0.12897, 1.15297}}};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      EXPECT_NEAR((*matrix)[column][row], rows.at(row).at(column), 2e-4) << row << ", " << column;
  }
  declared.chromaticities = Chromaticities{0.64, 0.33, 0.3, 0.6, 0.15, 0.06, 0.3127, 0.329};
  EXPECT_FALSE(rec709_from(declared, "file"));
  declared.chromaticities = Chromaticities{};
  EXPECT_THROW((void)rec709_from(declared, "file"), Error);
}

TEST(Declared, PrimariesOfAnExrCountForColoursAlone) {
  OIIO::ImageSpec spec = spec_with(1, 1, {"R", "G", "B"});
  const std::array<float, 8> aces{0.713F, 0.293F, 0.165F, 0.83F, 0.128F, 0.044F, 0.32168F, 0.33767F};
  spec.attribute("chromaticities", {OIIO::TypeDesc::FLOAT, 8}, aces.data());
  const fs::path file = written("aces.exr", spec);  // 0, 1, 2
  expect_texels(read_image(file, Transfer::linear), {0, 1, 2});
  const std::vector<float> converted{-0.6218F - 2 * 0.0833F, 1.1408F - 2 * 0.0106F, -0.1290F + 2 * 1.1530F};
  expect_texels(read_image(file, Transfer::declared), converted, 1e-3F);
  expect_texels(read_image(file, Transfer::srgb), converted, 1e-3F);
}

std::vector<std::uint8_t> half_png(const std::string& chunks) {
  return test::png_file(1, 1, 8, PngColor::rgb, "\0\x80\x80\x80"s, chunks);
}

std::string gamma_chunk(std::uint32_t gamma) { return test::png_chunk("gAMA", test::big_endian(gamma)); }

TEST(Declared, GammaOfAPngCountsForPicturesAlone) {
  const float half = 128 / 255.0F, srgb = 0.2158605F;
  const auto declared = [&](const std::string& chunks) {
    return read_image(half_png(chunks), "png", Transfer::declared).texels.front();
  };
  EXPECT_NEAR(declared(""), srgb, 1e-6);
  EXPECT_NEAR(declared(gamma_chunk(100000)), half, 1e-6);
  EXPECT_NEAR(declared(gamma_chunk(50000)), half * half, 1e-6);
  EXPECT_NEAR(declared(gamma_chunk(45455)), srgb, 1e-6) << "encoders write it for sRGB";
  EXPECT_NEAR(declared(test::png_chunk("sRGB", "\0"s) + gamma_chunk(100000)), srgb, 1e-6) << "sRGB is before gAMA";
  EXPECT_NEAR(declared(test::png_chunk("cICP", "\x01\x08\0\x01"s)), half, 1e-6);
  EXPECT_NEAR(declared(test::png_chunk("cICP", "\x01\x0d\0\x01"s) + gamma_chunk(100000)), srgb, 1e-6);
  EXPECT_THROW((void)declared(test::png_chunk("cICP", "\x09\x10\0\x01"s)), Error) << "BT.2020, PQ";
  EXPECT_EQ(read_image(half_png(gamma_chunk(100000)), "data", Transfer::linear).texels.front(), half);
  EXPECT_NEAR(read_image(half_png(gamma_chunk(100000)), "color", Transfer::srgb).texels.front(), srgb, 1e-6);
}

TEST(Declared, PrimariesOfAPngAreConverted) {
  std::string swapped, usual;  // red and green exchanged
  for (const std::uint32_t value : {31270U, 32900U, 30000U, 60000U, 64000U, 33000U, 15000U, 6000U})
    swapped += test::big_endian(value);
  for (const std::uint32_t value : {31270U, 32900U, 64000U, 33000U, 30000U, 60000U, 15000U, 6000U})
    usual += test::big_endian(value);
  const auto read = [](const std::string& chunks) {
    const auto file = test::png_file(1, 1, 8, PngColor::rgb, "\0\xff\0\x80"s, gamma_chunk(100000) + chunks);
    return read_image(file, "png", Transfer::declared);
  };
  expect_texels(read(test::png_chunk("cHRM", swapped)), {0, 1, 128 / 255.0F}, 1e-5F);
  expect_texels(read(test::png_chunk("cHRM", usual)), {1, 0, 128 / 255.0F});
}

TEST(Declared, ProfilesAreNamedAndIgnored) {
  const auto notes = [](const std::string& name) {
    const auto file = half_png(test::png_chunk("iCCP", name + "\0\0"s));
    return read_file_image(file, "png", Transfer::declared).notes;
  };
  ASSERT_EQ(notes("Wide Gamut").size(), 1U);
  EXPECT_TRUE(says(notes("Wide Gamut").front(), "Wide Gamut"));
  EXPECT_TRUE(notes("sRGB IEC61966-2.1").empty());
}

// Little-endian and big-endian EXIF of one entry.
std::string exif(char orientation, bool little) {
  if (little) return "II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0"s + orientation + "\0\0\0\0\0\0\0"s;
  return "MM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0"s + orientation + "\0\0\0\0\0\0"s;
}

TEST(Declared, ExifOfAPngTurnsPicturesAlone) {
  for (const bool little : {false, true}) {
    const auto file = test::png_file(2, 1, 8, PngColor::gray, "\0\x33\x66"s, test::png_chunk("eXIf", exif(6, little)));
    const FileImage data = read_file_image(file, "data", Transfer::linear);
    expect_texels(data.image, {0.2F, 0.4F});
    ASSERT_EQ(data.notes.size(), 1U);
    EXPECT_TRUE(says(data.notes.front(), "orientation (6)"));
    const FileImage picture = read_file_image(file, "picture", Transfer::declared);
    EXPECT_EQ(picture.image.height, 2);
    EXPECT_EQ(picture.image.width, 1);
    EXPECT_TRUE(picture.notes.empty());
  }
  EXPECT_EQ(exif_orientation("Exif\0\0"s + exif(3, true)), 3);
  EXPECT_EQ(exif_orientation(exif(9, true)), 1);
  EXPECT_EQ(exif_orientation("II*\0\xff\xff\xff\xff"s), 1);
  EXPECT_EQ(exif_orientation(""), 1);
}

// 6: the first row is the right side, the first column the top. 3: turned by half.
TEST(Declared, OrientationsOfTiffAndJpegTurnPictures) {
  OIIO::ImageSpec tiff = spec_with(2, 1, {"R", "G", "B"});
  tiff.attribute("Orientation", 6);
  const fs::path file = written("turned.tif", tiff);
  expect_texels(read_image(file, Transfer::linear), {0, 1, 2, 3, 4, 5});
  const Image turned = read_image(file, Transfer::declared);
  EXPECT_EQ(turned.height, 2);
  expect_texels(turned, {0, 1, 2, 3, 4, 5});
  OIIO::ImageSpec jpeg(16, 16, 3, OIIO::TypeDesc::UINT8);
  jpeg.attribute("Orientation", 3);
  const fs::path photo = written("turned.jpg", jpeg, 1 / 768.0F);
  const Image stored = read_image(photo, Transfer::srgb), picture = read_image(photo, Transfer::declared);
  EXPECT_GT(stored.texels.back(), stored.texels.front() + 0.5F);
  EXPECT_EQ(picture.texels[0], stored.at(15, 15)[0]);
  EXPECT_EQ(picture.at(15, 15)[2], stored.texels[2]);
}

TEST(Declared, FloatsOfATiffAreLinear) {
  const FileImage file = read_file_image(written("float.tif", spec_with(2, 1, {"R", "G", "B"})), Transfer::declared);
  EXPECT_TRUE(file.floats);
  expect_texels(file.image, {0, 1, 2, 3, 4, 5});
}

OIIO::ImageSpec windowed(const PixelWindow& stored, const PixelWindow& shown,
                         const std::vector<std::string>& channels) {
  OIIO::ImageSpec spec = spec_with(stored.width, stored.height, channels);
  spec.x = stored.x;
  spec.y = stored.y;
  spec.full_x = shown.x;
  spec.full_y = shown.y;
  spec.full_width = shown.width;
  spec.full_height = shown.height;
  return spec;
}

TEST(Declared, PixelsOfAnExrAreInTheirPlace) {
  const fs::path cropped = written("cropped.exr", windowed({1, -1, 1, 1}, {0, -2, 2, 2}, {"R", "G", "B"}));
  expect_texels(read_image(cropped, Transfer::linear), {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 2});
  const FileImage picture = read_file_image(cropped, Transfer::declared);
  expect_texels(picture.image, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 2, 1});  // coverage is where it stores
  EXPECT_EQ(picture.notes.size(), 1U);
  EXPECT_EQ(texels_in_header(cropped), 4U);
  const fs::path overscan = written("overscan.exr", windowed({-1, -1, 3, 3}, {0, 0, 1, 1}, {"R", "G", "B", "A"}));
  const FileImage middle = read_file_image(overscan, Transfer::declared);
  expect_texels(middle.image, {16, 17, 18, 19});
  EXPECT_TRUE(middle.notes.empty());
  const fs::path apart = written("apart.exr", windowed({5, 5, 1, 1}, {0, 0, 2, 2}, {"R", "G", "B"}));
  EXPECT_TRUE(says(refusal_of(apart, Transfer::linear), "stores no pixel"));
  const fs::path wide = written("wide.exr", windowed({0, 0, 1, 1}, {0, 0, 100000, 2}, {"R", "G", "B"}));
  EXPECT_TRUE(says(refusal_of(wide, Transfer::linear), "100000 x 2"));
  EXPECT_THROW((void)read_exr_chain(cropped), Error);
}

TEST(Declared, ChannelsAreChosenByTheirNames) {
  struct Choice {
    std::vector<std::string> names;
    std::vector<std::string> chosen;  // in the order of the image
    std::size_t notes;
  };
  const std::vector<Choice> choices{
      {{"R", "G", "B", "A"}, {"R", "G", "B", "A"}, 0},
      {{"R", "G", "B", "Z"}, {"R", "G", "B"}, 1},
      {{"R", "G", "B", "id"}, {"R", "G", "B"}, 1},
      {{"R", "G", "B", "A", "Z", "diffuse.R", "diffuse.G"}, {"R", "G", "B", "A"}, 1},
      {{"X", "Y", "Z"}, {"X", "Y", "Z"}, 0},
      {{"normal.X", "normal.Y", "normal.Z", "Q"}, {"normal.X", "normal.Y", "normal.Z"}, 2},
      {{"R", "G"}, {"R", "G"}, 0},
      {{"Y", "A"}, {"Y", "A"}, 0},
      {{"height"}, {"height"}, 0}};
  for (const auto& [names, chosen, notes] : choices) {
    SCOPED_TRACE(testing::PrintToString(names));
    const fs::path file = written("channels.exr", spec_with(2, 1, names));
    const ExrChain stored = read_exr_chain(file);
    const FileImage read = read_file_image(file, Transfer::linear);
    ASSERT_EQ(read.image.channels, static_cast<int>(chosen.size()));
    EXPECT_EQ(read.notes.size(), notes);
    for (std::size_t c = 0; c < chosen.size(); ++c) {
      const auto channel = std::ranges::find(stored.channels, chosen[c]) - stored.channels.begin();
      for (int x = 0; x < 2; ++x)
        EXPECT_EQ(read.image.at(x, 0)[c], stored.levels[0].at(x, 0)[static_cast<std::size_t>(channel)]);
    }
  }
}

TEST(Declared, ChannelsWithoutAMeaningAreRefused) {
  const fs::path xyz = written("xyz.exr", spec_with(2, 1, {"X", "Y", "Z"}));
  EXPECT_TRUE(says(refusal_of(xyz, Transfer::declared), "X, Y and Z: a vector or CIE XYZ"));
  EXPECT_EQ(refusal_of(xyz, Transfer::linear), "no error");
  const fs::path chroma = written("chroma.exr", spec_with(2, 1, {"Y", "RY", "BY"}));
  EXPECT_TRUE(says(refusal_of(chroma, Transfer::declared), "luminance and chroma"));
  const fs::path layers =
      written("layers.exr", spec_with(2, 1, {"left.R", "left.G", "left.B", "right.R", "right.G", "right.B"}));
  EXPECT_TRUE(says(refusal_of(layers, Transfer::declared), "left, right"));
}

TEST(Declared, FurtherChannelsOfATiffAreLeftOut) {
  OIIO::ImageSpec spec(2, 1, 5, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:UnassociatedAlpha", 1);
  const FileImage file = read_file_image(written("five.tif", spec, 1 / 255.0F), Transfer::linear);
  ASSERT_EQ(file.image.channels, 4);
  EXPECT_NEAR(file.image.at(1, 0)[0], 5 / 255.0F, 1e-6);
  EXPECT_EQ(file.notes.size(), 1U);
}

fs::path two_parts(const std::vector<std::string>& first, const std::vector<std::string>& second) {
  const fs::path file = fresh_folder() / "parts.exr";
  std::vector<OIIO::ImageSpec> specs{spec_with(1, 1, first), spec_with(1, 1, second)};
  specs[0].attribute("oiio:subimagename", "one");
  specs[1].attribute("oiio:subimagename", "two");
  const auto output = OIIO::ImageOutput::create(file.string());
  EXPECT_TRUE(output->open(file.string(), 2, specs.data()));
  const std::vector<float> ones(8, 1.0F), twos(8, 2.0F);
  EXPECT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, ones.data()));
  EXPECT_TRUE(output->open(file.string(), specs[1], OIIO::ImageOutput::AppendSubimage));
  EXPECT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, twos.data()) && output->close());
  return file;
}

TEST(Declared, ThePartWithColoursIsRead) {
  const FileImage second = read_file_image(two_parts({"Z"}, {"R", "G", "B"}), Transfer::declared);
  expect_texels(second.image, {2, 2, 2});
  ASSERT_EQ(second.notes.size(), 1U);
  EXPECT_TRUE(says(second.notes.front(), "`two`"));
  expect_texels(read_image(two_parts({"R", "G", "B"}, {"R", "G", "B"}), Transfer::declared), {1, 1, 1});
}

// A lossless WebP that keeps colours under alpha 0.
std::vector<std::uint8_t> webp_of(const std::vector<std::uint8_t>& rgba, int width) {
  WebPConfig config;
  WebPPicture picture;
  WebPMemoryWriter writer;
  EXPECT_TRUE(WebPConfigInit(&config) && WebPPictureInit(&picture));
  config.lossless = config.exact = 1;
  picture.use_argb = 1;
  picture.width = width;
  picture.height = static_cast<int>(rgba.size()) / 4 / width;
  WebPMemoryWriterInit(&writer);
  picture.writer = WebPMemoryWrite;
  picture.custom_ptr = &writer;
  EXPECT_TRUE(WebPPictureImportRGBA(&picture, rgba.data(), 4 * width) && WebPEncode(&config, &picture));
  std::vector<std::uint8_t> bytes(writer.mem, writer.mem + writer.size);
  WebPMemoryWriterClear(&writer);
  WebPPictureFree(&picture);
  return bytes;
}

TEST(Declared, AlphaOfAWebpLeavesColours) {
  const std::vector<std::uint8_t> rgba{255, 128, 0, 51, 10, 20, 30, 0, 1, 2, 3, 255};
  const Image image = read_image(webp_of(rgba, 3), "webp", Transfer::linear);
  ASSERT_EQ(image.channels, 4);
  for (std::size_t i = 0; i < rgba.size(); ++i)
    EXPECT_FLOAT_EQ(image.texels[i], static_cast<float>(rgba[i]) / 255.0F) << i;
}

TEST(Declared, AnimatedWebpIsRefused) {
  const std::string chunk = "VP8X\x0a\0\0\0\x02\0\0\0\x03\0\0\x03\0\0"s;
  const std::string rest = chunk + "ANIM\x06\0\0\0\0\0\0\0\0\0"s;
  const std::string file = "RIFF"s + static_cast<char>(rest.size() + 4) + "\0\0\0WEBP"s + rest;
  try {
    (void)read_image(bytes_from(file), "film", Transfer::linear);
    ADD_FAILURE() << "was taken";
  } catch (const Error& error) {
    EXPECT_TRUE(says(error.what(), "animation"));
  }
}

fs::path grey_tiff(const std::string& name, const std::vector<float>& rgba, bool associated) {
  const fs::path file = fresh_folder() / name;
  OIIO::ImageSpec spec = spec_with(static_cast<int>(rgba.size()) / 4, 1, {"R", "G", "B", "A"}, OIIO::TypeDesc::UINT8);
  if (!associated) spec.attribute("oiio:UnassociatedAlpha", 1);
  test::write_by_library(file, spec, rgba);
  return file;
}

TEST(Declared, AssociatedAlphaOfATiffIsDividedOrRefused) {
  const fs::path multiplied = grey_tiff("multiplied.tif", {0.2F, 0.1F, 0.0F, 0.4F}, true);
  EXPECT_TRUE(says(refusal_of(multiplied, Transfer::linear), "associated alpha"));
  EXPECT_NEAR(read_image(multiplied, Transfer::srgb).texels[0], 0.214041, 4e-3);  // of 0.5
  // Colours above alpha were not multiplied by it, whatever the file declares.
  const std::vector<float> straight{0.8F, 0.2F, 0.6F, 0.4F};
  expect_texels(read_image(grey_tiff("straight.tif", straight, true), Transfer::linear), straight);
  expect_texels(read_image(grey_tiff("other.tif", {0.2F, 0.2F, 0.0F, 0.4F}, false), Transfer::linear),
                {0.2F, 0.2F, 0.0F, 0.4F});
}

}  // namespace
}  // namespace footprint
