// PNG compresses the two halves of the floats well, and every browser decodes it.
#include "renderer/image/pixel_script.hpp"

#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/core/files.hpp"
#include "renderer/image/image_io.hpp"

namespace footprint {
namespace {

constexpr float largest_half = 65504.0F;
constexpr unsigned char covered = 255, left_out_of_figures = 254;

unsigned char coverage_byte(float coverage, bool is_left_out) {
  if (!(coverage > 0.0F)) return 0;
  if (coverage >= 1.0F) return is_left_out ? left_out_of_figures : covered;
  return static_cast<unsigned char>(std::clamp(coverage * 253.0F, 1.0F, 253.0F));
}

float coverage_of(const Image& image, std::size_t texel) {
  return image.channels == 4 ? image.texels[4 * texel + 3] : 1.0F;
}

// RGB of every texel; a grey image has three equal channels.
std::vector<std::uint16_t> halves_of(const Image& image) {
  std::vector<float> values(3 * image.texel_count());
  const auto channels = static_cast<std::size_t>(image.channels);
  for (std::size_t i = 0; i < image.texel_count(); ++i) {
    if (!(coverage_of(image, i) > 0.0F)) continue;
    for (std::size_t c = 0; c < 3; ++c)
      values[3 * i + c] = std::clamp(image.texels[channels * i + (channels > 1 ? c : 0)], -largest_half, largest_half);
  }
  std::vector<std::uint16_t> halves(values.size());
  OIIO::convert_pixel_values(OIIO::TypeDesc::FLOAT, values.data(), OIIO::TypeDesc::HALF, halves.data(),
                             static_cast<int>(values.size()));
  return halves;
}

}  // namespace

void write_pixel_script(const std::filesystem::path& file, const Image& image, const Image& left_out) {
  const std::vector<std::uint16_t> halves = halves_of(image);
  std::vector<unsigned char> bytes(3 * halves.size());
  for (std::size_t i = 0; i < halves.size(); ++i) {
    bytes[i] = static_cast<unsigned char>(halves[i] >> 8U);
    bytes[halves.size() + i] = static_cast<unsigned char>(halves[i] & 0xffU);
  }
  for (std::size_t i = 0; i < image.texel_count(); ++i)
    bytes[2 * halves.size() + 3 * i] =
        coverage_byte(coverage_of(image, i), !left_out.empty() && left_out.texels[i] > 0.0F);
  const auto png = encoded_png(file.string(), image.width, 3 * image.height, 3, bytes);
  const std::string text =
      OIIO::Strutil::base64_encode(std::string_view(reinterpret_cast<const char*>(png.data()), png.size()));
  write_file_atomically(file, "document.currentScript.pixels=\"data:image/png;base64," + text + "\";\n");
}

}  // namespace footprint
