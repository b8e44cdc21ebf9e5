// For tests of image files: files that OpenImageIO writes, and texels that were worked out by hand.
#pragma once

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <vector>

#include "renderer/image/image.hpp"

namespace footprint::test {

/// Writes one image of floats, in the format of the file's extension.
inline void write_by_library(const std::filesystem::path& file, const OIIO::ImageSpec& spec,
                             const std::vector<float>& texels) {
  const auto output = OIIO::ImageOutput::create(file.string());
  EXPECT_TRUE(output && output->open(file.string(), spec)) << OIIO::geterror();
  EXPECT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, texels.data()) && output->close()) << output->geterror();
}

template <class Value = double>
void expect_texels(const Image& image, const std::vector<Value>& expected, double tolerance = 1e-6) {
  ASSERT_EQ(image.texels.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(image.texels[i], expected[i], tolerance) << i;
}

}  // namespace footprint::test
