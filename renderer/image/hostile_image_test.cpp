// Files that are no image, or claim to be a larger one than they are: one clear error each.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "renderer/core/error.hpp"
#include "renderer/core/files.hpp"
#include "renderer/image/image_io.hpp"
#include "tests/support/fresh_folder.hpp"
#include "tests/support/png_file.hpp"
#include "tests/support/says.hpp"

namespace footprint {
namespace {

namespace fs = std::filesystem;
using test::fresh_folder;
using test::PngColor;
using test::says;

// The text of the usage error that reading ends in, which names the file and leaves nothing in OpenImageIO's queue.
std::string refusal(const std::function<Image()>& read) {
  try {
    (void)read();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage) << error.what();
    EXPECT_FALSE(error.place().empty());
    EXPECT_FALSE(error.hint().empty());
    EXPECT_FALSE(OIIO::has_error()) << OIIO::geterror();
    return error.what();
  }
  return "no error";
}

std::string refusal(const fs::path& file) {
  return refusal([&] { return read_image(file, Transfer::linear); });
}

std::string refusal(const std::vector<std::uint8_t>& bytes) {
  return refusal([&] { return read_image(bytes, "buffer 3", Transfer::linear); });
}

std::vector<std::uint8_t> encoded(const std::string& format, int channels = 3,
                                  const std::vector<std::string>& names = {}) {
  std::mt19937 generator(1);
  std::vector<std::uint8_t> texels(static_cast<std::size_t>(64 * 64 * channels));
  for (std::uint8_t& texel : texels) texel = static_cast<std::uint8_t>(generator());
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput target(bytes);
  const auto output = OIIO::ImageOutput::create(format, &target);
  OIIO::ImageSpec spec(64, 64, channels, OIIO::TypeDesc::UINT8);
  if (!names.empty()) spec.channelnames = names;
  EXPECT_TRUE(output->open("memory", spec));
  EXPECT_TRUE(output->write_image(OIIO::TypeDesc::UINT8, texels.data()) && output->close());
  return bytes;
}

TEST(HostileImage, MissingFile) { EXPECT_TRUE(says(refusal(fresh_folder() / "absent.png"), "no such file")); }

TEST(HostileImage, FolderInPlaceOfAFile) { EXPECT_TRUE(says(refusal(fresh_folder()), "is not a file")); }

TEST(HostileImage, EmptyFile) {
  const fs::path file = fresh_folder() / "empty.png";
  write_file_atomically(file, "");
  EXPECT_TRUE(says(refusal(file), "is empty"));
  EXPECT_TRUE(says(refusal(file), file.string()));
  EXPECT_TRUE(says(refusal(std::vector<std::uint8_t>{}), "buffer 3: the file is empty"));
}

TEST(HostileImage, TextFile) {
  const fs::path file = fresh_folder() / "text.png";
  write_file_atomically(file, "This is not an image.\n");
  EXPECT_TRUE(says(refusal(file), "is not an image"));
  EXPECT_TRUE(says(refusal(std::vector<std::uint8_t>{'h', 'i'}), "is not an image"));
}

TEST(HostileImage, TruncatedAnywhere) {
  for (const std::string format : {"png", "jpeg", "openexr", "tiff", "bmp", "webp", "hdr"}) {
    const std::vector<std::uint8_t> whole = encoded(format);
    EXPECT_NO_THROW((void)read_image(whole, format, Transfer::linear)) << format;
    for (const double share : {0.001, 0.01, 0.1, 0.5, 0.9}) {
      std::vector<std::uint8_t> part = whole;
      part.resize(static_cast<std::size_t>(share * static_cast<double>(whole.size())) + 4);
      EXPECT_NE(refusal(part), "no error") << format << " cut to " << part.size() << " of " << whole.size();
    }
  }
}

TEST(HostileImage, TruncatedOnDisk) {
  const fs::path file = fresh_folder() / "half.jpg";
  std::vector<std::uint8_t> bytes = encoded("jpeg");
  bytes.resize(bytes.size() / 2);
  write_file_atomically(file, bytes);
  EXPECT_TRUE(says(refusal(file), "truncated"));
}

// 10^6 x 10^6 texels are 3 TB; the header alone must do.
TEST(HostileImage, AMillionTexelsASide) {
  const auto huge = test::png_file(1000000, 1000000, 8, PngColor::rgb, "");
  EXPECT_TRUE(says(refusal(huge), "1000000 x 1000000"));
  const auto wide = test::png_file(1000000, 1, 8, PngColor::rgb, "");
  EXPECT_TRUE(says(refusal(wide), "1000000 x 1"));
}

TEST(HostileImage, TheLargestSideIsTheCallers) {
  const std::vector<std::uint8_t> bytes = encoded("png");
  EXPECT_NO_THROW((void)read_image(bytes, "png", Transfer::linear, 64));
  EXPECT_TRUE(says(refusal([&] { return read_image(bytes, "png", Transfer::linear, 63); }), "64 x 64"));
}

TEST(HostileImage, NoTexelAtAll) {
  EXPECT_NE(refusal(test::png_file(0, 4, 8, PngColor::rgb, "")), "no error");
  EXPECT_NE(refusal(test::png_file(4, 0, 8, PngColor::rgb, "")), "no error");
}

TEST(HostileImage, MoreThanFourChannelsWithoutKnownNames) {
  EXPECT_TRUE(says(refusal(encoded("openexr", 5, {"a0", "a1", "a2", "a3", "a4"})), "5 channels"));
}

TEST(HostileImage, WrongChecksum) {
  std::vector<std::uint8_t> bytes = encoded("png");
  bytes[bytes.size() / 2] ^= 0xff;
  EXPECT_NE(refusal(bytes), "no error");
}

// Any flipped bytes end in a picture or in an error, never in a crash.
TEST(HostileImage, FlippedBytesNeverCrash) {
  std::mt19937 generator(7);
  for (const std::string format : {"png", "jpeg", "openexr"}) {
    const std::vector<std::uint8_t> whole = encoded(format);
    for (int round = 0; round < 200; ++round) {
      std::vector<std::uint8_t> bytes = whole;
      const std::size_t reach = round % 2 == 0 ? 64 : bytes.size();  // headers are the tender spot
      for (int flip = 0; flip < 3; ++flip) bytes[generator() % reach] = static_cast<std::uint8_t>(generator());
      try {
        const Image image = read_image(bytes, format, Transfer::linear, 4096);
        EXPECT_LE(image.width, 4096);
      } catch (const Error& error) {
        EXPECT_NE(error.kind(), ErrorKind::check) << error.what();
      }
    }
  }
}

}  // namespace
}  // namespace footprint
